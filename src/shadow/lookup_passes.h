// The look-up of a frame's receivers, in strips of a large image: one dispatch over a strip, and further ones over
// those receivers whose answer takes longer (see lookup.comp.in).
#pragma once

#include <span>
#include <vector>

#include "shadewright/gpu/pass.h"
#include "shadewright/shadow/technique.h"
#include "shadow/shared.h"

namespace shadewright::shadow {

/// Receivers of a strip, for whose further passes one dimension of a dispatch is long enough on every device.
constexpr uint64_t most_deferred = uint64_t{65535} * shared::deferred_group;

class LookupPasses {
 public:
  /// What modules know when their look-up is compiled: their lookup_constant().
  struct Known {
    uint32_t storage = 0, parameterization = 0;
  };

  LookupPasses() = default;
  /// For images of `extent` pixels; set 1 is of `lookup_layout`.
  LookupPasses(const gpu::Device& device, const Spec& spec, vk::Extent2D extent, vk::DescriptorSetLayout lookup_layout,
               uint32_t light_kind, Known known);

  /// Looks up `receivers` (bindings 0 to 2 of set 0) into all of `visibility`, and leaves that to be sampled.
  void record(const vk::raii::CommandBuffer& commands, std::vector<gpu::Binding> receivers,
              vk::DescriptorSet lookup_set, gpu::Image& visibility) const;
  std::vector<Allocation> allocations() const;

 private:
  void record_strip(const vk::raii::CommandBuffer& commands, const shared::ReceiverStrip& strip,
                    std::span<const gpu::Binding> bindings, vk::DescriptorSet lookup_set, gpu::Image& visibility) const;

  vk::Extent2D extent_;
  std::vector<shared::ReceiverStrip> strips_;  ///< looked up one after the other, into the same buffers
  std::vector<gpu::ComputePass> passes_;
  gpu::Buffer answers_;   ///< of the first pass, a byte a pixel; unless it stores them itself
  gpu::Buffer deferred_;  ///< DeferredReceivers of each pass, then their pixels; with several passes
};

}  // namespace shadewright::shadow
