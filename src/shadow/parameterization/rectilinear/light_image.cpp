#include "shadow/parameterization/rectilinear/light_image.h"

namespace shadewright::shadow {

LightImage::LightImage(const gpu::Device& device, uint32_t size, uint32_t frames_in_flight)
    : device_(device), draws_(1, frames_in_flight), sampler_(gpu::make_sampler(device, vk::Filter::eNearest)) {
  using Usage = vk::ImageUsageFlagBits;
  image_ = gpu::Image(device, {"light image", vk::Format::eD32Sfloat, size, size, 1,
                               Usage::eDepthStencilAttachment | Usage::eSampled, true});
}

void LightImage::prepare(const Frame& frame, uint32_t slot, const MapView& view) {
  view_ = view;
  view_.viewport = vk::Rect2D({0, 0}, image_.extent());
  draws_.prepare(frame, slot, std::span(&view_, 1));
}

void LightImage::record(const Frame& frame, uint32_t slot, const ReceiverLookup& receivers, gpu::Recorder& recorder) {
  if (!pipelines_made_) {
    // The uniform parameterization draws view 0 of the same set as it is.
    const Spec plain = parse_spec("uniform/depth/hard");
    draws_.make_pipelines(device_, {plain, receivers.layout, {}});
    pipelines_made_ = true;
  }
  Frame scene_only = frame;  // the caller's own casters are drawn warped
  scene_only.draw_casters = {};
  draws_.cull(scene_only, slot, receivers, recorder);
  recorder.stage("light image", [&](const vk::raii::CommandBuffer& commands) {
    draws_.draw_targets(commands, scene_only, image_, {}, receivers.set);
  });
}

std::vector<Allocation> LightImage::allocations() const {
  std::vector<Allocation> result = draws_.allocations();
  result.push_back(image_.allocation());
  return result;
}

}  // namespace shadewright::shadow
