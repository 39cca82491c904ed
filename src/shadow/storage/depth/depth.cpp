#include "shadow/storage/depth/depth.h"

#include "shadow/lookup_shaders.h"
#include "shadow/storage/depth_picture.h"

namespace shadewright::shadow {

DepthStorage::DepthStorage(const gpu::Device& device, const StorageDesc& desc)
    : device_(device),
      sampler_(gpu::make_sampler(device, vk::Filter::eNearest)),
      draws_(desc.extent.layers, desc.frames_in_flight) {
  using Usage = vk::ImageUsageFlagBits;
  map_ = gpu::Image(device,
                    {"shadow map", vk::Format::eD32Sfloat, desc.extent.width, desc.extent.height, desc.extent.layers,
                     Usage::eDepthStencilAttachment | Usage::eSampled | Usage::eTransferSrc, true});
  gpu::GraphicsDesc pipeline = casters_shaders(desc.spec);
  CasterDraws::describe(pipeline, desc.lookup_layout);
  pass_ = gpu::GraphicsPass(device, pipeline);
}

void DepthStorage::prepare(const Frame& frame, uint32_t slot, std::span<const MapView> views) {
  draws_.prepare(frame, slot, views);
}

void DepthStorage::record(const Frame& frame, uint32_t slot, std::span<const MapView> views,
                          vk::DescriptorSet lookup_set, gpu::Recorder& recorder) {
  draws_.cull(frame, slot, recorder);
  recorder.stage("shadow map", [&](const vk::raii::CommandBuffer& commands) {
    draws_.draw_views(commands, frame, views, map_, {}, pass_, lookup_set);
  });
}

std::vector<gpu::Binding> DepthStorage::lookup_bindings() const {
  return {gpu::Binding::sampled(map_.view(), *sampler_)};
}

Picture DepthStorage::debug_picture(std::string_view) {
  return depth_picture(device_, map_);
}

std::vector<Allocation> DepthStorage::allocations() const {
  std::vector<Allocation> result = draws_.allocations();
  result.insert(result.begin(), map_.allocation());
  return result;
}

}  // namespace shadewright::shadow
