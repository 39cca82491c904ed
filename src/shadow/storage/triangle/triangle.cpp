#include "shadow/storage/triangle/triangle.h"

#include "shadow/lookup_shaders.h"
#include "shadow/storage/depth_picture.h"
#include "shadow/storage/triangle/shared.h"

namespace shadewright::shadow {

TriangleStorage::TriangleStorage(const gpu::Device& device, const StorageDesc& desc)
    : device_(device),
      sampler_(gpu::make_sampler(device, vk::Filter::eNearest)),
      draws_(desc.extent.layers, desc.frames_in_flight) {
  using Usage = vk::ImageUsageFlagBits;
  const MapExtent& extent = desc.extent;
  depth_ = gpu::Image(device, {"triangle depth", vk::Format::eD32Sfloat, extent.width, extent.height, extent.layers,
                               Usage::eDepthStencilAttachment | Usage::eSampled | Usage::eTransferSrc, true});
  gpu::GraphicsDesc pipeline = casters_shaders(desc.spec);
  CasterDraws::describe(pipeline, desc.lookup_layout);
  constexpr std::array formats{vk::Format::eR32G32B32A32Sfloat, vk::Format::eR32G32B32A32Sfloat,
                               vk::Format::eR32Sfloat};
  for (size_t i = 0; i < formats.size(); ++i) {
    vertices_[i] = gpu::Image(device, {"triangle map", formats[i], extent.width, extent.height, extent.layers,
                                       Usage::eColorAttachment | Usage::eSampled, true});
    pipeline.colors.push_back(formats[i]);
  }
  pass_ = gpu::GraphicsPass(device, pipeline);
  const shared::TriangleLookup constants{desc.spec.choice("kernel") == "5" ? 2 : 1};
  constants_ = gpu::make_buffer<shared::TriangleLookup>(device, "triangle constants", std::span(&constants, 1));
}

void TriangleStorage::prepare(const Frame& frame, uint32_t slot, std::span<const MapView> views) {
  draws_.prepare(frame, slot, views);
}

void TriangleStorage::record(const Frame& frame, uint32_t slot, std::span<const MapView> views,
                             vk::DescriptorSet lookup_set, gpu::Recorder& recorder) {
  draws_.cull(frame, slot, recorder);
  recorder.stage("shadow map", [&](const vk::raii::CommandBuffer& commands) {
    draws_.draw_views(commands, frame, views, depth_, vertices_, pass_, lookup_set);
  });
}

std::vector<gpu::Binding> TriangleStorage::lookup_bindings() const {
  std::vector<gpu::Binding> bindings{gpu::Binding::sampled(depth_.view(), *sampler_)};
  for (const gpu::Image& image : vertices_) bindings.push_back(gpu::Binding::sampled(image.view(), *sampler_));
  bindings.push_back(gpu::Binding::uniform(constants_));
  return bindings;
}

Picture TriangleStorage::debug_picture(std::string_view) {
  return depth_picture(device_, depth_);
}

std::vector<Allocation> TriangleStorage::allocations() const {
  std::vector<Allocation> result{depth_.allocation(), constants_.allocation()};
  for (const gpu::Image& image : vertices_) result.push_back(image.allocation());
  for (Allocation& allocation : draws_.allocations()) result.push_back(std::move(allocation));
  return result;
}

}  // namespace shadewright::shadow
