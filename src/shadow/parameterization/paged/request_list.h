// The pages that a frame's pixels ask for as a list without repetitions: RMSM's algorithm 2, steps 1 to 8: a request a
// pixel, connected components, compaction, sort, compaction. The host reads the two counts, as the paper's does.
#pragma once

#include <functional>

#include "gpu/compaction.h"
#include "gpu/radix_sort.h"
#include "shadow/parameterization/parameterization.h"

namespace shadewright::shadow {

/// What requests are marked and counted in.
struct RequestMasks {
  const gpu::Buffer &requested, &requested_or_finer, &state;
};

class RequestList {
 public:
  RequestList() = default;
  /// For an image of `width` x `height` pixels that ask for a page at each of `levels` levels. Pages are numbered below
  /// `pages`.
  RequestList(const gpu::Device& device, uint32_t width, uint32_t height, uint32_t levels, uint32_t pages,
              vk::DescriptorSetLayout lookup_layout, bool six_faces);

  /// Fills the list from the receivers, and marks what it has no room for. Submits and waits.
  void find(const ReceiverLookup& lookup, const RequestMasks& masks, gpu::Recorder& recorder);
  /// Marks the list's pages in the masks.
  void mark(const vk::raii::CommandBuffer& commands, const gpu::Buffer& constants, const RequestMasks& masks) const;

  explicit operator bool() const { return capacity_ > 0; }
  uint32_t compacted() const { return compacted_; }  ///< requests left by the first compaction: what is sorted
  uint32_t unique() const { return unique_; }
  std::vector<Allocation> allocations() const;

 private:
  uint32_t read_count(const std::function<void(const vk::raii::CommandBuffer&)>& compact, uint32_t of,
                      const char* stage, gpu::Recorder& recorder) const;

  glm::uvec2 size_{0};
  uint32_t levels_ = 0, key_bits_ = 0, capacity_ = 0, compacted_ = 0, unique_ = 0;
  gpu::ComputePass list_pass_, components_pass_, mark_pass_;
  gpu::Compaction compaction_;
  gpu::RadixSort sort_;
  gpu::Buffer requests_, kept_, count_;
};

}  // namespace shadewright::shadow
