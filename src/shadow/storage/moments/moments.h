// moments: the map keeps two moments of the light's distance, which may be blurred (Donnelly and Lauritzen, "Variance
// Shadow Maps", I3D 2006; the blur and the plane's own variance as in Lauritzen, "Summed-Area Variance Shadow Maps",
// GPU Gems 3).
//
// hard     one texel answers
// pcf      texels are averaged over a box of `blur` texels to each side, and bilinearly in the look-up
// bleeding the share of light below which nothing counts: less of the known light leaks, harder shadows
// What differs: distances are metres in the world, so that any parameterization will do, and the second number is the
// variance, not the mean square: 32-bit floats then lose nothing in the difference of the two.
#pragma once

#include "shadow/storage/storage.h"

namespace shadewright::shadow {

class MomentsStorage final : public Storage {
 public:
  MomentsStorage(const gpu::Device& device, const StorageDesc& desc);

  void record(const Frame& frame, vk::DescriptorSet lookup_set, gpu::Recorder& recorder) override;
  std::vector<gpu::Binding> lookup_bindings() const override;
  std::vector<Allocation> allocations() const override;
  /// The mean distances, near bright, layers one below the other; black where a layer holds nothing.
  Picture debug_picture(std::string_view name) override;

 private:
  void draw(const vk::raii::CommandBuffer& commands, const Frame& frame, vk::DescriptorSet lookup_set);
  void blur(const vk::raii::CommandBuffer& commands);

  const gpu::Device& device_;
  int32_t radius_;                ///< of the blur, texels
  gpu::Image map_, depth_, row_;  ///< depth and the half-blurred map serve one layer after the other
  vk::raii::Sampler sampler_;
  gpu::GraphicsPass blur_;
  CasterDraws& draws_;
};

}  // namespace shadewright::shadow
