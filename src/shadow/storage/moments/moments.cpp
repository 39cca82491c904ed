#include "shadow/storage/moments/moments.h"

#include <algorithm>
#include <limits>

#include "shaders/blur_moments_frag.h"
#include "shaders/whole_image_vert.h"
#include "shadewright/render/image.h"
#include "shadow/storage/map_picture.h"

namespace shadewright::shadow {

namespace {

struct BlurPush {
  glm::ivec2 step;
  int32_t radius, layer;  ///< of the source
};

constexpr auto moments_format = vk::Format::eR32G32Sfloat;

/// A distance no caster or receiver exceeds, as light_distance.glsl measures it: what a texel without caster keeps.
float farthest(const Frame& frame) {
  double result = 0;
  for (const Box& box : {frame.scene ? frame.scene->bounds() : Box{}, frame.draw_bounds})
    if (!box.empty())
      for (const glm::dvec3& corner : box.corners())
        result = std::max(result, frame.light.kind == LightKind::directional
                                      ? glm::dot(corner - frame.camera.eye(), frame.light.direction)
                                      : glm::distance(corner, frame.light.position));
  return static_cast<float>(result);
}

}  // namespace

MomentsStorage::MomentsStorage(const gpu::Device& device, const StorageDesc& desc)
    : device_(device),
      radius_(desc.spec.takes("blur") ? static_cast<int32_t>(desc.spec.number("blur")) : 0),
      sampler_(gpu::make_sampler(device, vk::Filter::eNearest)),
      draws_(desc.draws) {
  using Usage = vk::ImageUsageFlagBits;
  const MapExtent& extent = desc.extent;
  map_ = gpu::Image(device, {"shadow map", moments_format, extent.width, extent.height, extent.layers,
                             Usage::eColorAttachment | Usage::eSampled | Usage::eTransferSrc, true});
  depth_ = gpu::Image(
      device, {"shadow depth", vk::Format::eD32Sfloat, extent.width, extent.height, 1, Usage::eDepthStencilAttachment});
  if (radius_ > 0) {
    row_ = gpu::Image(device, {"shadow blur", moments_format, extent.width, extent.height, 1,
                               Usage::eColorAttachment | Usage::eSampled, true});
    gpu::GraphicsDesc pass;
    pass.vertex = shaders::whole_image_vert;
    pass.fragment = shaders::blur_moments_frag;
    pass.kinds = {gpu::BindingKind::sampled_image};
    pass.push_bytes = sizeof(BlurPush);
    pass.colors = {moments_format};
    pass.depth = vk::Format::eUndefined;
    blur_ = gpu::GraphicsPass(device, pass);
  }
  draws_.make_pipelines(device, {desc.spec, desc.lookup_layout, {moments_format}});
}

void MomentsStorage::record(const Frame& frame, vk::DescriptorSet lookup_set, gpu::Recorder& recorder) {
  recorder.stage("shadow map", [&](const vk::raii::CommandBuffer& commands) {
    draw(commands, frame, lookup_set);
    if (radius_ == 0) map_.transition(commands, vk::ImageLayout::eShaderReadOnlyOptimal);
  });
  if (radius_ > 0)
    recorder.stage("blur", [&](const vk::raii::CommandBuffer& commands) {
      blur(commands);
      map_.transition(commands, vk::ImageLayout::eShaderReadOnlyOptimal);
    });
}

void MomentsStorage::draw(const vk::raii::CommandBuffer& commands, const Frame& frame, vk::DescriptorSet lookup_set) {
  using Layout = vk::ImageLayout;
  const std::span<const MapView> targets = draws_.targets();
  const vk::ClearValue empty(vk::ClearColorValue(farthest(frame), 0.0f, 0.0f, 0.0f));
  map_.transition(commands, Layout::eColorAttachmentOptimal, true);
  for (uint32_t index = 0; index < targets.size(); ++index) {
    if (!targets[index].drawn) continue;
    depth_.transition(commands, Layout::eDepthAttachmentOptimal, true);
    const vk::RenderingAttachmentInfo color(map_.layer_view(targets[index].layer), Layout::eColorAttachmentOptimal, {},
                                            {}, {}, vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore, empty);
    const vk::RenderingAttachmentInfo depth(depth_.view(), Layout::eDepthAttachmentOptimal, {}, {}, {},
                                            vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eDontCare,
                                            vk::ClearDepthStencilValue(1.0f, 0));
    commands.beginRendering({{}, {{0, 0}, map_.extent()}, 1, 0, color, &depth});
    draws_.draw(commands, frame, index, lookup_set);
    commands.endRendering();
  }
}

void MomentsStorage::blur(const vk::raii::CommandBuffer& commands) {
  using Layout = vk::ImageLayout;
  const vk::Rect2D area{{0, 0}, map_.extent()};
  commands.setViewport(
      0, vk::Viewport(0, 0, static_cast<float>(area.extent.width), static_cast<float>(area.extent.height), 0, 1));
  commands.setScissor(0, area);
  const auto pass = [&](gpu::Image& source, gpu::Image& target, uint32_t layer, const BlurPush& push) {
    source.transition(commands, Layout::eShaderReadOnlyOptimal);
    target.transition(commands, Layout::eColorAttachmentOptimal);
    const vk::RenderingAttachmentInfo color(target.layer_view(layer), Layout::eColorAttachmentOptimal, {}, {}, {},
                                            vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eStore);
    commands.beginRendering({{}, area, 1, 0, color});
    const gpu::Binding bindings[] = {gpu::Binding::sampled(source.view(), *sampler_)};
    blur_.bind(commands, bindings, gpu::bytes_of(push));
    commands.draw(3, 1, 0, 0);
    commands.endRendering();
  };
  for (const MapView& target : draws_.targets()) {
    if (!target.drawn) continue;
    pass(map_, row_, 0, {{1, 0}, radius_, static_cast<int32_t>(target.layer)});
    pass(row_, map_, target.layer, {{0, 1}, radius_, 0});
  }
}

std::vector<gpu::Binding> MomentsStorage::lookup_bindings() const {
  return {gpu::Binding::sampled(map_.view(), *sampler_)};
}

Picture MomentsStorage::debug_picture(std::string_view) {
  constexpr float nothing = std::numeric_limits<float>::infinity();
  std::vector<float> brightness = map_values(device_, map_, 2 * sizeof(float), draws_, nothing);
  float low = nothing, high = -nothing;
  for (const float distance : brightness) {
    if (distance == nothing) continue;
    low = std::min(low, distance);
    high = std::max(high, distance);
  }
  const float range = std::max(high - low, std::numeric_limits<float>::min());
  for (float& distance : brightness) distance = distance == nothing ? 0.0f : 1.0f - (distance - low) / range;
  return render::to_picture(brightness, map_.desc().width, map_.desc().height * map_.desc().layers);
}

std::vector<Allocation> MomentsStorage::allocations() const {
  std::vector<Allocation> result;
  for (const gpu::Image* image : {&row_, &depth_, &map_})
    if (*image) result.insert(result.begin(), image->allocation());
  return result;
}

}  // namespace shadewright::shadow
