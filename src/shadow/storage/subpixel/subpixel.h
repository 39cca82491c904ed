// subpixel: Sub-Pixel Shadow Mapping (Lecocq, Marvie, Sourimant, Gautron, I3D 2014). A texel keeps the closest triangle
// in 128 bits, conservatively rasterized; the look-up tests it and its neighbours, and rebuilds the border where
// neither holds the receiver. Ours differs:
// - Figure 9's consistent minimum depth is found once a texel, when it is drawn. The depth attachment orders triangles
//   by it, and the look-up reads it (the paper finds it at each look-up; its section 7 proposes this).
// - Of closed bodies only the sides that look away from the light are drawn: they begin at the silhouette, which the
//   least depth then picks, and lit faces meet no map of themselves. Lattice at 512: 2,146 wrong pixels, not 5,014.
// - recovery=silhouettes (default): a texel also tells which of its triangle's edges are silhouettes (a bit each, from
//   the triangles across them), which replaces the guess at tangents; recovery=tangents is the paper's. Which texels
//   are occluded is decided where the triangle is, not by a slope's worth of slack. A close-up of lattice, 2048: 1,132
//   wrong pixels, not 3,070.
// - slopes=wide (default) has 11 bits a slope and depth within the texel; power is the paper's, linear figure 6's.
#pragma once

#include "shadow/storage/storage.h"

namespace shadewright::shadow {

class SubpixelStorage final : public Storage {
 public:
  SubpixelStorage(const gpu::Device& device, const StorageDesc& desc);

  void record(const Frame& frame, vk::DescriptorSet lookup_set, gpu::Recorder& recorder) override;
  std::vector<gpu::Binding> lookup_bindings() const override;
  void write_lookup(shared::LookupData& lookup) const override;
  uint32_t lookup_constant() const override { return recovery_ + 1; }
  std::vector<Allocation> allocations() const override;
  /// The consistent minimum depths, near bright and empty black, layers one below the other.
  Picture debug_picture(std::string_view name) override;

 private:
  const gpu::Device& device_;
  gpu::Image triangles_, minimum_;
  shared::SlopeCoding coding_;
  uint32_t recovery_;
  gpu::Buffer slopes_, tangents_;
  vk::raii::Sampler sampler_;
  CasterDraws& draws_;
};

}  // namespace shadewright::shadow
