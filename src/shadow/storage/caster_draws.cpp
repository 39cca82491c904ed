#include "shadow/storage/caster_draws.h"

#include <algorithm>

namespace shadewright::shadow {

namespace {

/// What a view that draws nothing lets through.
const Plane nothing{{0, 0, 0}, -1};

}  // namespace

void CasterDraws::describe(gpu::GraphicsDesc& desc, vk::DescriptorSetLayout lookup_layout) {
  render::CulledDraws::set_vertex_input(desc, render::SceneInputs::position);
  desc.sets = {lookup_layout};
  desc.push_bytes = sizeof(uint32_t);
  desc.depth_clamp = true;
}

void CasterDraws::prepare(const Frame& frame, uint32_t slot, std::span<const MapView> views) {
  if (!frame.scene) return;
  if (scene_ != frame.scene) {
    draws_.emplace(*frame.scene, max_views_, frames_in_flight_, "shadow");
    scene_ = frame.scene;
  }
  std::vector<std::vector<Plane>> planes;
  std::transform(views.begin(), views.end(), std::back_inserter(planes),
                 [](const MapView& view) { return view.drawn ? view.casters : std::vector<Plane>{nothing}; });
  draws_->set_views(slot, planes, {}, frame.casters);
}

void CasterDraws::cull(const Frame& frame, uint32_t slot, gpu::Recorder& recorder) const {
  if (frame.scene)
    recorder.stage("shadow cull", [&](const vk::raii::CommandBuffer& commands) { draws_->cull(commands, slot); });
}

void CasterDraws::draw_views(const vk::raii::CommandBuffer& commands, const Frame& frame,
                             std::span<const MapView> views, gpu::Image& depth, std::span<gpu::Image> colors,
                             const gpu::GraphicsPass& pass, vk::DescriptorSet lookup_set) const {
  using Layout = vk::ImageLayout;
  depth.transition(commands, Layout::eDepthAttachmentOptimal, true);
  for (gpu::Image& image : colors) image.transition(commands, Layout::eColorAttachmentOptimal, true);
  for (uint32_t index = 0; index < views.size(); ++index) {
    const MapView& view = views[index];
    if (!view.drawn) continue;
    const vk::RenderingAttachmentInfo depth_target(depth.layer_view(view.layer), Layout::eDepthAttachmentOptimal, {},
                                                   {}, {}, vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
                                                   vk::ClearDepthStencilValue(1.0f, 0));
    std::vector<vk::RenderingAttachmentInfo> color_targets;
    for (const gpu::Image& image : colors)
      color_targets.push_back({image.layer_view(view.layer),
                               Layout::eColorAttachmentOptimal,
                               {},
                               {},
                               {},
                               vk::AttachmentLoadOp::eDontCare,
                               vk::AttachmentStoreOp::eStore});
    vk::RenderingInfo rendering({}, {{0, 0}, depth.extent()}, 1, 0, color_targets);
    rendering.pDepthAttachment = &depth_target;
    commands.beginRendering(rendering);
    draw(commands, frame, view, index, pass, lookup_set);
    commands.endRendering();
  }
  depth.transition(commands, Layout::eShaderReadOnlyOptimal);
  for (gpu::Image& image : colors) image.transition(commands, Layout::eShaderReadOnlyOptimal);
}

void CasterDraws::draw(const vk::raii::CommandBuffer& commands, const Frame& frame, const MapView& view, uint32_t index,
                       const gpu::GraphicsPass& pass, vk::DescriptorSet lookup_set) const {
  const vk::Rect2D area = view.viewport;
  commands.setViewport(
      0, vk::Viewport(static_cast<float>(area.offset.x), static_cast<float>(area.offset.y),
                      static_cast<float>(area.extent.width), static_cast<float>(area.extent.height), 0, 1));
  commands.setScissor(0, area);
  if (frame.scene) {
    pass.bind(commands, {}, gpu::bytes_of(index), std::span(&lookup_set, 1));
    draws_->draw(commands, index);
  }
  if (frame.draw_casters) frame.draw_casters({commands, index, view, lookup_set});
}

std::vector<Allocation> CasterDraws::allocations() const {
  return draws_ ? draws_->allocations() : std::vector<Allocation>{};
}

}  // namespace shadewright::shadow
