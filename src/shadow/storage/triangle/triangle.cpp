#include "shadow/storage/triangle/triangle.h"

#include "shadow/storage/map_picture.h"

namespace shadewright::shadow {

TriangleStorage::TriangleStorage(const gpu::Device& device, const StorageDesc& desc)
    : device_(device),
      reach_(desc.spec.choice("kernel") == "5" ? 2 : 1),
      sampler_(gpu::make_sampler(device, vk::Filter::eNearest)),
      draws_(desc.draws) {
  using Usage = vk::ImageUsageFlagBits;
  const MapExtent& extent = desc.extent;
  depth_ = gpu::Image(device, {"triangle depth", vk::Format::eD32Sfloat, extent.width, extent.height, extent.layers,
                               Usage::eDepthStencilAttachment | Usage::eSampled | Usage::eTransferSrc, true});
  constexpr std::array formats{vk::Format::eR32G32B32A32Sfloat, vk::Format::eR32G32B32A32Sfloat,
                               vk::Format::eR32Sfloat};
  for (size_t i = 0; i < formats.size(); ++i)
    vertices_[i] = gpu::Image(device, {"triangle map", formats[i], extent.width, extent.height, extent.layers,
                                       Usage::eColorAttachment | Usage::eSampled, true});
  draws_.make_pipelines(device, {desc.spec, desc.lookup_layout, {formats.begin(), formats.end()}});
}

void TriangleStorage::record(const Frame& frame, vk::DescriptorSet lookup_set, gpu::Recorder& recorder) {
  recorder.stage("shadow map", [&](const vk::raii::CommandBuffer& commands) {
    draws_.draw_targets(commands, frame, depth_, vertices_, lookup_set);
  });
}

std::vector<gpu::Binding> TriangleStorage::lookup_bindings() const {
  std::vector<gpu::Binding> bindings{gpu::Binding::sampled(depth_.view(), *sampler_)};
  for (const gpu::Image& image : vertices_) bindings.push_back(gpu::Binding::sampled(image.view(), *sampler_));
  return bindings;
}

Picture TriangleStorage::debug_picture(std::string_view) {
  return depth_picture(device_, depth_, draws_);
}

std::vector<Allocation> TriangleStorage::allocations() const {
  std::vector<Allocation> result{depth_.allocation()};
  for (const gpu::Image& image : vertices_) result.push_back(image.allocation());
  return result;
}

}  // namespace shadewright::shadow
