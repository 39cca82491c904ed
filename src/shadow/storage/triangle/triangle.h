// triangle: Reconstructable Geometry Shadow Maps (Dai, Bao, Chen, 2008). A texel keeps the closest triangle's three
// vertices in world space; a receiver's ray is tested against those of the 3x3 or 5x5 texels around it. Plainly
// rasterized: a triangle that covers no texel's centre is lost, which is the method's known failure with fine meshes.
// The baseline of SPSM's figure 13. 36 bytes a texel and its depth; the paper does not say how it stores them.
#pragma once

#include <array>

#include "shadow/storage/storage.h"

namespace shadewright::shadow {

class TriangleStorage final : public Storage {
 public:
  TriangleStorage(const gpu::Device& device, const StorageDesc& desc);

  void record(const Frame& frame, vk::DescriptorSet lookup_set, gpu::Recorder& recorder) override;
  std::vector<gpu::Binding> lookup_bindings() const override;
  void write_lookup(shared::LookupData& lookup) const override { lookup.triangle_reach = reach_; }
  std::vector<Allocation> allocations() const override;
  /// The depths, near bright and empty black, layers one below the other.
  Picture debug_picture(std::string_view name) override;

 private:
  const gpu::Device& device_;
  gpu::Image depth_;
  std::array<gpu::Image, 3> vertices_;
  int reach_;  ///< texels to each side whose triangles are tested
  vk::raii::Sampler sampler_;
  CasterDraws& draws_;
};

}  // namespace shadewright::shadow
