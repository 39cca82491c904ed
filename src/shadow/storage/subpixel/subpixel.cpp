#include "shadow/storage/subpixel/subpixel.h"

#include <memory>

#include "shadow/storage/map_picture.h"
#include "shadow/storage/subpixel/slope_table.h"
#include "shadow/storage/subpixel/tangents.h"

namespace shadewright::shadow {

namespace {

uint32_t recovery(std::string_view name) {
  if (name == "off") return shared::recovery_off;
  return name == "tangents" ? shared::recovery_tangents : shared::recovery_silhouettes;
}

gpu::Buffer make_slopes(const gpu::Device& device, const shared::SlopeCoding& coding) {
  const auto table = std::make_unique<shared::SubpixelSlopes>();
  make_slope_table(coding, table->slopes);
  return gpu::make_buffer<shared::SubpixelSlopes>(device, "sub-pixel slopes", std::span(table.get(), 1));
}

gpu::Buffer make_tangents(const gpu::Device& device) {
  const auto tables = std::make_unique<shared::SubpixelTangents>();
  for (uint32_t pattern = 0; pattern < 512; ++pattern) {
    const TangentPattern found = tangent_pattern(pattern);
    using Kind = TangentPattern::Kind;
    tables->tangent_counts[pattern] = found.kind == Kind::lit        ? shared::tangents_lit
                                      : found.kind == Kind::shadowed ? shared::tangents_shadowed
                                                                     : static_cast<uint32_t>(found.normals.size());
    for (size_t i = 0; i < found.normals.size(); ++i) tables->tangents[4 * pattern + i] = glm::vec2(found.normals[i]);
  }
  return gpu::make_buffer<shared::SubpixelTangents>(device, "sub-pixel tangents", std::span(tables.get(), 1));
}

}  // namespace

SubpixelStorage::SubpixelStorage(const gpu::Device& device, const StorageDesc& desc)
    : device_(device),
      coding_(slope_coding(desc.spec.choice("slopes"))),
      recovery_(recovery(desc.spec.choice("recovery"))),
      slopes_(make_slopes(device, coding_)),
      tangents_(make_tangents(device)),
      sampler_(gpu::make_sampler(device, vk::Filter::eNearest)),
      draws_(desc.draws) {
  using Usage = vk::ImageUsageFlagBits;
  const MapExtent& extent = desc.extent;
  triangles_ = gpu::Image(device, {"sub-pixel map", vk::Format::eR32G32B32A32Uint, extent.width, extent.height,
                                   extent.layers, Usage::eColorAttachment | Usage::eSampled, true});
  minimum_ =
      gpu::Image(device, {"sub-pixel minimum depth", vk::Format::eD32Sfloat, extent.width, extent.height, extent.layers,
                          Usage::eDepthStencilAttachment | Usage::eSampled | Usage::eTransferSrc, true});
  draws_.make_pipelines(
      device, {desc.spec, desc.lookup_layout, {triangles_.desc().format}, render::SceneInputs::position, true, extent});
}

void SubpixelStorage::record(const Frame& frame, vk::DescriptorSet lookup_set, gpu::Recorder& recorder) {
  recorder.stage("shadow map", [&](const vk::raii::CommandBuffer& commands) {
    draws_.draw_targets(commands, frame, minimum_, std::span(&triangles_, 1), lookup_set);
  });
}

std::vector<gpu::Binding> SubpixelStorage::lookup_bindings() const {
  return {gpu::Binding::sampled(triangles_.view(), *sampler_), gpu::Binding::sampled(minimum_.view(), *sampler_),
          gpu::Binding::uniform(slopes_), gpu::Binding::storage(tangents_)};
}

void SubpixelStorage::write_lookup(shared::LookupData& lookup) const {
  lookup.slope_coding = coding_;
  lookup.recovery = recovery_;
}

Picture SubpixelStorage::debug_picture(std::string_view) {
  return depth_picture(device_, minimum_, draws_);
}

std::vector<Allocation> SubpixelStorage::allocations() const {
  return {triangles_.allocation(), minimum_.allocation(), slopes_.allocation(), tangents_.allocation()};
}

}  // namespace shadewright::shadow
