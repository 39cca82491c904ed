#include "shadow/storage/depth/depth.h"

#include "shadow/storage/map_picture.h"

namespace shadewright::shadow {

DepthStorage::DepthStorage(const gpu::Device& device, const StorageDesc& desc)
    : device_(device), sampler_(gpu::make_sampler(device, vk::Filter::eNearest)), draws_(desc.draws) {
  using Usage = vk::ImageUsageFlagBits;
  map_ = gpu::Image(device,
                    {"shadow map", vk::Format::eD32Sfloat, desc.extent.width, desc.extent.height, desc.extent.layers,
                     Usage::eDepthStencilAttachment | Usage::eSampled | Usage::eTransferSrc, true});
  draws_.make_pipelines(device, {desc.spec, desc.lookup_layout, {}});
}

void DepthStorage::record(const Frame& frame, vk::DescriptorSet lookup_set, gpu::Recorder& recorder) {
  recorder.stage("shadow map", [&](const vk::raii::CommandBuffer& commands) {
    draws_.draw_targets(commands, frame, map_, {}, lookup_set);
  });
}

std::vector<gpu::Binding> DepthStorage::lookup_bindings() const {
  return {gpu::Binding::sampled(map_.view(), *sampler_)};
}

Picture DepthStorage::debug_picture(std::string_view) {
  return depth_picture(device_, map_, draws_);
}

std::vector<Allocation> DepthStorage::allocations() const {
  return {map_.allocation()};
}

}  // namespace shadewright::shadow
