#include "shadow/lookup_passes.h"

#include <array>

#include "shadow/lookup_shaders.h"
#include "shadow/shared.h"
#include "shadow/storage/storage.h"

namespace shadewright::shadow {

namespace {

/// FILTER_PASSES of the filter's GLSL.
uint32_t pass_count(const Spec& spec) {
  if (!storage_traits(spec.storage).in_passes) return 1;
  return spec.filter == "hard" ? 4 : 2;
}

}  // namespace

LookupPasses::LookupPasses(const gpu::Device& device, const Spec& spec, vk::Extent2D extent,
                           std::vector<gpu::BindingKind> kinds, vk::DescriptorSetLayout lookup_layout, uint32_t light_kind,
                           Known known)
    : extent_(extent) {
  const uint32_t count = pass_count(spec);
  if (count > 1) {
    deferred_ = gpu::Buffer(device, "deferred receivers",
                            shared::max_lookup_passes * sizeof(shared::DeferredReceivers) +
                                uint64_t{count - 1} * extent.width * extent.height * sizeof(uint32_t));
    kinds.push_back(gpu::BindingKind::storage_buffer);
  }
  const auto shader = lookup_shader(spec.parameterization + "/" + spec.storage + "/" + spec.filter);
  for (uint32_t pass = 0; pass < count; ++pass)
    passes_.push_back(gpu::ComputePass(device, shader, kinds, 0, std::span(&lookup_layout, 1),
                                       {light_kind, pass, known.storage, known.parameterization}));
}

void LookupPasses::record(const vk::raii::CommandBuffer& commands, std::vector<gpu::Binding> bindings,
                          vk::DescriptorSet lookup_set) const {
  const std::span sets(&lookup_set, 1);
  if (deferred_) {
    std::array<shared::DeferredReceivers, shared::max_lookup_passes> none;
    none.fill({{0, 1, 1}, 0});
    commands.updateBuffer<shared::DeferredReceivers>(deferred_.handle(), 0, none);
    gpu::memory_barrier(commands);
    bindings.push_back(gpu::Binding::storage(deferred_));
  }
  passes_[0].dispatch(commands, bindings, {}, {gpu::groups(extent_.width, 8), gpu::groups(extent_.height, 8), 1}, sets);
  for (size_t pass = 1; pass < passes_.size(); ++pass) {
    gpu::memory_barrier(commands);
    passes_[pass].dispatch_indirect(commands, bindings, {}, deferred_, pass * sizeof(shared::DeferredReceivers), sets);
  }
}

std::vector<Allocation> LookupPasses::allocations() const {
  return deferred_ ? std::vector{deferred_.allocation()} : std::vector<Allocation>{};
}

}  // namespace shadewright::shadow
