#include "shadewright/gpu/pass.h"

#include <array>

namespace shadewright::gpu {

namespace {

vk::raii::ShaderModule make_shader(const Device& device, std::span<const uint32_t> spirv) {
  return {device.handle(), vk::ShaderModuleCreateInfo({}, spirv.size_bytes(), spirv.data())};
}

vk::raii::PipelineLayout make_layout(const Device& device, const vk::raii::DescriptorSetLayout& pushed,
                                     std::span<const vk::DescriptorSetLayout> sets, uint32_t push_bytes,
                                     vk::ShaderStageFlags stages) {
  std::vector<vk::DescriptorSetLayout> layouts{*pushed};
  layouts.insert(layouts.end(), sets.begin(), sets.end());
  const vk::PushConstantRange range(stages, 0, push_bytes);
  vk::PipelineLayoutCreateInfo info({}, layouts);
  if (push_bytes > 0) info.setPushConstantRanges(range);
  return {device.handle(), info};
}

/// Descriptor writes with the storage that they point into.
class Writes {
 public:
  explicit Writes(std::span<const Binding> bindings, vk::DescriptorSet set = {}, uint32_t first = 0)
      : buffers_(bindings.size()), images_(bindings.size()) {
    for (uint32_t i = 0; i < bindings.size(); ++i) {
      const Binding& b = bindings[i];
      vk::WriteDescriptorSet write(set, first + i, 0, 1, descriptor_type(b.kind));
      if (b.buffer) {
        buffers_[i] = vk::DescriptorBufferInfo(b.buffer, 0, b.bytes);
        write.pBufferInfo = &buffers_[i];
      } else {
        images_[i] = vk::DescriptorImageInfo(b.sampler, b.view, b.layout);
        write.pImageInfo = &images_[i];
      }
      writes_.push_back(write);
    }
  }
  const std::vector<vk::WriteDescriptorSet>& list() const { return writes_; }

 private:
  std::vector<vk::DescriptorBufferInfo> buffers_;
  std::vector<vk::DescriptorImageInfo> images_;
  std::vector<vk::WriteDescriptorSet> writes_;
};

/// Values of specialization constants 0, 1, ..., with the storage that vk points into.
class Specialization {
 public:
  explicit Specialization(std::span<const uint32_t> values) {
    for (uint32_t i = 0; i < values.size(); ++i)
      entries_.emplace_back(i, static_cast<uint32_t>(i * sizeof(uint32_t)), sizeof(uint32_t));
    info_ = {static_cast<uint32_t>(entries_.size()), entries_.data(), values.size_bytes(), values.data()};
  }
  const vk::SpecializationInfo& info() const { return info_; }

 private:
  std::vector<vk::SpecializationMapEntry> entries_;
  vk::SpecializationInfo info_;
};

void bind_sets(const vk::raii::CommandBuffer& commands, vk::PipelineBindPoint point,
               const vk::raii::PipelineLayout& layout, std::span<const Binding> bindings,
               std::span<const vk::DescriptorSet> sets) {
  if (!bindings.empty()) commands.pushDescriptorSetKHR(point, *layout, 0, Writes(bindings).list());
  if (!sets.empty())
    commands.bindDescriptorSets(point, *layout, 1, vk::ArrayProxy(static_cast<uint32_t>(sets.size()), sets.data()), {});
}

void push_constants(const vk::raii::CommandBuffer& commands, const vk::raii::PipelineLayout& layout,
                    vk::ShaderStageFlags stages, std::span<const std::byte> push) {
  if (!push.empty())
    commands.pushConstants<std::byte>(*layout, stages, 0, {static_cast<uint32_t>(push.size()), push.data()});
}

constexpr vk::ShaderStageFlags graphics_stages = vk::ShaderStageFlagBits::eAllGraphics;

}  // namespace

vk::DescriptorType descriptor_type(BindingKind kind) {
  switch (kind) {
    case BindingKind::storage_buffer:
      return vk::DescriptorType::eStorageBuffer;
    case BindingKind::uniform_buffer:
      return vk::DescriptorType::eUniformBuffer;
    case BindingKind::sampled_image:
      return vk::DescriptorType::eCombinedImageSampler;
    case BindingKind::storage_image:
      return vk::DescriptorType::eStorageImage;
  }
  return vk::DescriptorType::eStorageBuffer;
}

vk::raii::DescriptorSetLayout make_set_layout(const Device& device, std::span<const BindingKind> kinds,
                                              vk::ShaderStageFlags stages, bool push) {
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (uint32_t i = 0; i < kinds.size(); ++i) bindings.push_back({i, descriptor_type(kinds[i]), 1, stages});
  vk::DescriptorSetLayoutCreateInfo info({}, bindings);
  if (push) info.flags = vk::DescriptorSetLayoutCreateFlagBits::ePushDescriptorKHR;
  return {device.handle(), info};
}

void write_set(const Device& device, vk::DescriptorSet set, uint32_t first, std::span<const Binding> bindings) {
  if (!bindings.empty()) device.handle().updateDescriptorSets(Writes(bindings, set, first).list(), {});
}

vk::raii::Sampler make_sampler(const Device& device, vk::Filter filter) {
  vk::SamplerCreateInfo info({}, filter, filter, vk::SamplerMipmapMode::eNearest);
  info.addressModeU = info.addressModeV = info.addressModeW = vk::SamplerAddressMode::eClampToBorder;
  info.borderColor = vk::BorderColor::eFloatOpaqueWhite;
  return {device.handle(), info};
}

ComputePass::ComputePass(const Device& device, std::span<const uint32_t> spirv, const std::vector<BindingKind>& kinds,
                         uint32_t push_bytes, std::span<const vk::DescriptorSetLayout> sets,
                         std::initializer_list<uint32_t> constants) {
  set_layout_ = make_set_layout(device, kinds, vk::ShaderStageFlagBits::eCompute, true);
  layout_ = make_layout(device, set_layout_, sets, push_bytes, vk::ShaderStageFlagBits::eCompute);
  const auto shader = make_shader(device, spirv);
  const Specialization specialization({constants.begin(), constants.size()});
  const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *shader, "main",
                                                &specialization.info());
  pipeline_ = vk::raii::Pipeline(device.handle(), nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout_));
}

void ComputePass::dispatch(const vk::raii::CommandBuffer& commands, std::span<const Binding> bindings,
                           std::span<const std::byte> push, vk::Extent3D groups,
                           std::span<const vk::DescriptorSet> sets) const {
  bind(commands, bindings, push, sets);
  commands.dispatch(groups.width, groups.height, groups.depth);
}

void ComputePass::dispatch_indirect(const vk::raii::CommandBuffer& commands, std::span<const Binding> bindings,
                                    std::span<const std::byte> push, const Buffer& buffer, uint64_t offset,
                                    std::span<const vk::DescriptorSet> sets) const {
  bind(commands, bindings, push, sets);
  commands.dispatchIndirect(buffer.handle(), offset);
}

void ComputePass::bind(const vk::raii::CommandBuffer& commands, std::span<const Binding> bindings,
                       std::span<const std::byte> push, std::span<const vk::DescriptorSet> sets) const {
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
  bind_sets(commands, vk::PipelineBindPoint::eCompute, layout_, bindings, sets);
  push_constants(commands, layout_, vk::ShaderStageFlagBits::eCompute, push);
}

GraphicsPass::GraphicsPass(const Device& device, const GraphicsDesc& desc) {
  set_layout_ = make_set_layout(device, desc.kinds, graphics_stages, true);
  layout_ = make_layout(device, set_layout_, desc.sets, desc.push_bytes, graphics_stages);
  std::vector<vk::raii::ShaderModule> modules;
  std::vector<vk::PipelineShaderStageCreateInfo> stages;
  const Specialization specialization(desc.constants);
  const auto add = [&](vk::ShaderStageFlagBits stage, std::span<const uint32_t> spirv) {
    if (spirv.empty()) return;
    modules.push_back(make_shader(device, spirv));
    stages.push_back({{}, stage, *modules.back(), "main", &specialization.info()});
  };
  using Stage = vk::ShaderStageFlagBits;
  add(Stage::eVertex, desc.vertex);
  add(Stage::eTessellationControl, desc.tessellation_control);
  add(Stage::eTessellationEvaluation, desc.tessellation_evaluation);
  add(Stage::eGeometry, desc.geometry);
  add(Stage::eFragment, desc.fragment);
  const bool tessellated = !desc.tessellation_control.empty();
  const vk::PipelineVertexInputStateCreateInfo vertex_input({}, desc.vertex_bindings, desc.vertex_attributes);
  const vk::PipelineInputAssemblyStateCreateInfo assembly(
      {}, tessellated ? vk::PrimitiveTopology::ePatchList : vk::PrimitiveTopology::eTriangleList);
  const vk::PipelineTessellationStateCreateInfo tessellation({}, 3);
  const vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
  vk::PipelineRasterizationStateCreateInfo raster;
  raster.depthClampEnable = desc.depth_clamp;
  raster.lineWidth = 1;
  const vk::PipelineMultisampleStateCreateInfo multisample;
  const vk::PipelineDepthStencilStateCreateInfo depth({}, VK_TRUE, VK_TRUE, desc.depth_compare);
  vk::PipelineColorBlendAttachmentState opaque;
  using Mask = vk::ColorComponentFlagBits;
  opaque.colorWriteMask = Mask::eR | Mask::eG | Mask::eB | Mask::eA;
  const std::vector<vk::PipelineColorBlendAttachmentState> attachments(desc.colors.size(), opaque);
  const vk::PipelineColorBlendStateCreateInfo blend({}, VK_FALSE, {}, attachments);
  const std::array dynamic_states{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
  const vk::PipelineDynamicStateCreateInfo dynamic({}, dynamic_states);
  const vk::PipelineRenderingCreateInfo rendering(0, desc.colors, desc.depth);

  vk::GraphicsPipelineCreateInfo info({}, stages, &vertex_input, &assembly, tessellated ? &tessellation : nullptr,
                                      &viewport, &raster, &multisample, &depth, &blend, &dynamic, *layout_);
  info.pNext = &rendering;
  pipeline_ = vk::raii::Pipeline(device.handle(), nullptr, info);
}

void GraphicsPass::bind(const vk::raii::CommandBuffer& commands, std::span<const Binding> bindings,
                        std::span<const std::byte> push, std::span<const vk::DescriptorSet> sets) const {
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
  bind_sets(commands, vk::PipelineBindPoint::eGraphics, layout_, bindings, sets);
  this->push(commands, push);
}

void GraphicsPass::push(const vk::raii::CommandBuffer& commands, std::span<const std::byte> push) const {
  push_constants(commands, layout_, graphics_stages, push);
}

}  // namespace shadewright::gpu
