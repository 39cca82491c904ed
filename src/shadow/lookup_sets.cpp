#include "shadow/lookup_sets.h"

namespace shadewright::shadow {

LookupSets::LookupSets(const gpu::Device& device, std::span<const Part> parts, uint32_t count) {
  constexpr auto stages = vk::ShaderStageFlagBits::eAllGraphics | vk::ShaderStageFlagBits::eCompute;
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  std::vector<vk::DescriptorPoolSize> sizes;
  for (const Part& part : parts)
    for (uint32_t i = 0; i < part.kinds.size(); ++i) {
      const vk::DescriptorType type = gpu::descriptor_type(part.kinds[i]);
      bindings.push_back({part.first + i, type, 1, stages});
      sizes.push_back({type, count});
    }
  layout_ = vk::raii::DescriptorSetLayout(device.handle(), {{}, bindings});
  pool_ =
      vk::raii::DescriptorPool(device.handle(), {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, count, sizes});
  const std::vector<vk::DescriptorSetLayout> layouts(count, *layout_);
  for (auto& set : vk::raii::DescriptorSets(device.handle(), {*pool_, layouts})) sets_.push_back(std::move(set));
}

gpu::Image make_visibility(const gpu::Device& device, const TechniqueOptions& options) {
  using Usage = vk::ImageUsageFlagBits;
  return {device,
          {"visibility", vk::Format::eR8Unorm, options.width, options.height, 1,
           Usage::eStorage | Usage::eSampled | Usage::eTransferSrc | Usage::eTransferDst}};
}

}  // namespace shadewright::shadow
