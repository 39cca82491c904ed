#include "shadow/caster_draws.h"

#include <algorithm>

namespace shadewright::shadow {

bool CasterDraws::holds(uint32_t layer) const {
  return keeps() ||
         std::ranges::any_of(targets(), [&](const MapView& view) { return view.drawn && view.layer == layer; });
}

void CasterDraws::draw_targets(const vk::raii::CommandBuffer& commands, const Frame& frame, gpu::Image& depth,
                               std::span<gpu::Image> colors, vk::DescriptorSet lookup_set) const {
  using Layout = vk::ImageLayout;
  const bool keep = keeps();
  depth.transition(commands, Layout::eDepthAttachmentOptimal, !keep);
  for (gpu::Image& image : colors) image.transition(commands, Layout::eColorAttachmentOptimal, !keep);
  const std::span<const MapView> all = targets();
  for (uint32_t index = 0; index < all.size(); ++index) {
    const MapView& target = all[index];
    if (!target.drawn) continue;
    before(commands, frame, index, lookup_set);
    const vk::RenderingAttachmentInfo depth_target(depth.layer_view(target.layer), Layout::eDepthAttachmentOptimal, {},
                                                   {}, {},
                                                   keep ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eClear,
                                                   vk::AttachmentStoreOp::eStore, vk::ClearDepthStencilValue(1.0f, 0));
    std::vector<vk::RenderingAttachmentInfo> color_targets;
    for (const gpu::Image& image : colors)
      color_targets.push_back({image.layer_view(target.layer),
                               Layout::eColorAttachmentOptimal,
                               {},
                               {},
                               {},
                               keep ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eDontCare,
                               vk::AttachmentStoreOp::eStore});
    vk::RenderingInfo rendering({}, {{0, 0}, depth.extent()}, 1, 0, color_targets);
    rendering.pDepthAttachment = &depth_target;
    commands.beginRendering(rendering);
    draw(commands, frame, index, lookup_set);
    commands.endRendering();
  }
  depth.transition(commands, Layout::eShaderReadOnlyOptimal);
  for (gpu::Image& image : colors) image.transition(commands, Layout::eShaderReadOnlyOptimal);
}

}  // namespace shadewright::shadow
