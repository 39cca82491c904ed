// The look-up of a frame's receivers: one dispatch over the image, and further ones over those receivers whose answer
// takes longer (see lookup.comp.in).
#pragma once

#include <span>
#include <vector>

#include "shadewright/gpu/pass.h"
#include "shadewright/shadow/technique.h"

namespace shadewright::shadow {

class LookupPasses {
 public:
  LookupPasses() = default;
  /// For images of `extent` pixels, with bindings of `kinds` in set 0; set 1 is of `lookup_layout`. `storage_constant`:
  /// Storage::lookup_constant.
  LookupPasses(const gpu::Device& device, const Spec& spec, vk::Extent2D extent, std::vector<gpu::BindingKind> kinds,
               vk::DescriptorSetLayout lookup_layout, bool six_faces, uint32_t storage_constant);

  void record(const vk::raii::CommandBuffer& commands, std::vector<gpu::Binding> bindings,
              vk::DescriptorSet lookup_set) const;
  std::vector<Allocation> allocations() const;

 private:
  vk::Extent2D extent_;
  std::vector<gpu::ComputePass> passes_;
  gpu::Buffer deferred_;  ///< DeferredReceivers of each pass, then their pixels; with several passes
};

}  // namespace shadewright::shadow
