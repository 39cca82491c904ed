// Prefix sums on the device, in time linear in their number: sums of blocks, their sums, and both together (Sengupta et
// al., "A work-efficient step-efficient prefix sum algorithm", 2006, as blocks of 1,024 with a subgroup's sums inside).
#pragma once

#include "shadewright/gpu/pass.h"

namespace shadewright::gpu {

class Scan {
 public:
  Scan() = default;
  /// Serves up to `max_count` numbers.
  Scan(const Device& device, uint32_t max_count);

  /// Replaces the first `count` numbers (uint32) of `values` by the sum of those before each. A barrier must follow.
  void record(const vk::raii::CommandBuffer& commands, const Buffer& values, uint32_t count) const;
  /// Where the sum of all stands afterwards: this many numbers into `totals`.
  static uint32_t total_index(uint32_t count) { return groups(count, 1024); }
  const Buffer& totals() const { return totals_; }

 private:
  ComputePass blocks_, block_totals_, add_;
  Buffer totals_;
};

}  // namespace shadewright::gpu
