// Keeps the values of a list that are not ~0, in order: a scan tells each its place (Sengupta et al. 2006). And the
// list without repetitions, once it is sorted.
#pragma once

#include "gpu/scan.h"

namespace shadewright::gpu {

class Compaction {
 public:
  Compaction() = default;
  /// Serves lists of up to `max_count` values.
  Compaction(const Device& device, uint32_t max_count);

  /// Writes those of the first `count` values (uint32) that are not ~0 to `compact`. A barrier must follow; then
  /// scan().totals() holds their number at Scan::total_index(count).
  void record(const vk::raii::CommandBuffer& commands, const Buffer& values, uint32_t count,
              const Buffer& compact) const;
  /// The same, less what repeats its predecessor. `values` and `compact` differ.
  void record_unique(const vk::raii::CommandBuffer& commands, const Buffer& values, uint32_t count,
                     const Buffer& compact) const;
  const Scan& scan() const { return scan_; }
  std::vector<Allocation> allocations() const;

 private:
  ComputePass flags_, scatter_, mark_repeats_;
  Scan scan_;
  Buffer places_, marked_;
};

}  // namespace shadewright::gpu
