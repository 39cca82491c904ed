// Sorts unsigned integers on the device: least significant digit first, four bits a pass, each a count, a scan and a
// stable scatter (Satish, Harris, Garland, "Designing efficient sorting algorithms for manycore GPUs", 2009).
#pragma once

#include "gpu/scan.h"

namespace shadewright::gpu {

class RadixSort {
 public:
  RadixSort() = default;
  /// Serves up to `max_count` keys.
  RadixSort(const Device& device, uint32_t max_count);

  /// Sorts the first `count` keys (uint32), all below 2^bits, in place. A barrier must follow.
  void record(const vk::raii::CommandBuffer& commands, const Buffer& keys, uint32_t count, uint32_t bits) const;
  std::vector<Allocation> allocations() const;

 private:
  ComputePass count_, scatter_;
  Scan scan_;
  Buffer counts_, other_;
};

}  // namespace shadewright::gpu
