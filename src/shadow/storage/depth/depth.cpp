#include "shadow/storage/depth/depth.h"

#include <algorithm>

namespace shadewright::shadow {

DepthStorage::DepthStorage(const gpu::Device& device, uint32_t resolution, uint32_t layers, uint32_t frames_in_flight,
                           std::span<const uint32_t> vertex, vk::DescriptorSetLayout lookup_layout)
    : device_(device), frames_in_flight_(frames_in_flight) {
  using Usage = vk::ImageUsageFlagBits;
  map_ = gpu::Image(device, {"shadow map", vk::Format::eD32Sfloat, resolution, resolution, layers,
                             Usage::eDepthStencilAttachment | Usage::eSampled | Usage::eTransferSrc, true});
  gpu::GraphicsDesc desc;
  desc.vertex = vertex;
  render::CulledDraws::set_vertex_input(desc, render::SceneInputs::position);
  desc.sets = {lookup_layout};
  desc.push_bytes = sizeof(uint32_t);
  desc.depth_clamp = true;
  pass_ = gpu::GraphicsPass(device, desc);
}

void DepthStorage::prepare(const Frame& frame, uint32_t slot, std::span<const MapView> views) {
  if (!frame.scene) return;
  if (scene_ != frame.scene) {
    draws_.emplace(*frame.scene, map_.desc().layers, frames_in_flight_, "shadow");
    scene_ = frame.scene;
  }
  std::vector<std::vector<Plane>> planes;
  std::transform(views.begin(), views.end(), std::back_inserter(planes),
                 [](const MapView& view) { return view.casters; });
  draws_->set_views(slot, planes);
}

void DepthStorage::record(const Frame& frame, uint32_t slot, std::span<const MapView> views,
                          vk::DescriptorSet lookup_set, gpu::Recorder& recorder) {
  if (frame.scene)
    recorder.stage("shadow cull", [&](const vk::raii::CommandBuffer& commands) { draws_->cull(commands, slot); });
  recorder.stage("shadow map", [&](const vk::raii::CommandBuffer& commands) {
    map_.transition(commands, vk::ImageLayout::eDepthAttachmentOptimal, true);
    for (uint32_t index = 0; index < views.size(); ++index)
      if (views[index].drawn) draw_view(commands, frame, views[index], index, lookup_set);
    map_.transition(commands, vk::ImageLayout::eShaderReadOnlyOptimal);
  });
}

void DepthStorage::draw_view(const vk::raii::CommandBuffer& commands, const Frame& frame, const MapView& view,
                             uint32_t index, vk::DescriptorSet lookup_set) {
  const vk::RenderingAttachmentInfo depth(map_.layer_view(view.layer), vk::ImageLayout::eDepthAttachmentOptimal, {}, {},
                                          {}, vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
                                          vk::ClearDepthStencilValue(1.0f, 0));
  vk::RenderingInfo rendering({}, {{0, 0}, map_.extent()}, 1);
  rendering.pDepthAttachment = &depth;
  commands.beginRendering(rendering);
  const vk::Rect2D area = view.viewport;
  commands.setViewport(
      0, vk::Viewport(static_cast<float>(area.offset.x), static_cast<float>(area.offset.y),
                      static_cast<float>(area.extent.width), static_cast<float>(area.extent.height), 0, 1));
  commands.setScissor(0, area);
  if (frame.scene) {
    pass_.bind(commands, {}, gpu::bytes_of(index), std::span(&lookup_set, 1));
    draws_->draw(commands, index);
  }
  if (frame.draw_casters) frame.draw_casters({commands, index, view, lookup_set});
  commands.endRendering();
}

Picture DepthStorage::picture() {
  const gpu::ImageDesc& desc = map_.desc();
  std::vector<float> brightness;
  for (uint32_t layer = 0; layer < desc.layers; ++layer) {
    const auto bytes = gpu::read_back(device_, map_, sizeof(float), layer);
    const size_t first = brightness.size();
    brightness.resize(first + bytes.size() / sizeof(float));
    std::memcpy(&brightness[first], bytes.data(), bytes.size());
  }
  gpu::submit_and_wait(
      device_, [&](const auto& commands) { map_.transition(commands, vk::ImageLayout::eShaderReadOnlyOptimal); });
  for (float& depth : brightness) depth = depth == 1.0f ? 0.0f : 1.0f - 0.9f * depth;
  return render::to_picture(brightness, desc.width, desc.height * desc.layers);
}

std::vector<Allocation> DepthStorage::allocations() const {
  std::vector<Allocation> result{map_.allocation()};
  if (draws_)
    for (auto& allocation : draws_->allocations()) result.push_back(std::move(allocation));
  return result;
}

}  // namespace shadewright::shadow
