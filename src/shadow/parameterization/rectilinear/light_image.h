// The scene's depth from the light, not warped: what forward and hybrid analysis look at.
#pragma once

#include "shadow/view_caster_draws.h"

namespace shadewright::shadow {

class LightImage {
 public:
  LightImage(const gpu::Device& device, uint32_t size, uint32_t frames_in_flight);

  /// Host work of a frame.
  void prepare(const Frame& frame, uint32_t slot, const MapView& view);
  /// Records the stages "shadow cull" and "light image": view 0 of the look-up's set. The image is left readable by
  /// shaders.
  void record(const Frame& frame, uint32_t slot, const ReceiverLookup& receivers, gpu::Recorder& recorder);

  uint32_t size() const { return image_.desc().width; }
  gpu::Binding binding() const { return gpu::Binding::sampled(image_.view(), *sampler_); }
  std::vector<Allocation> allocations() const;

 private:
  const gpu::Device& device_;
  ViewCasterDraws draws_;
  MapView view_;
  gpu::Image image_;
  vk::raii::Sampler sampler_;
  bool pipelines_made_ = false;
};

}  // namespace shadewright::shadow
