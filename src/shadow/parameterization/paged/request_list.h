// The pages that a frame's pixels ask for as a list: a request a pixel, thinned by RMSM's algorithm 2, steps 4 to 8:
// connected components, compaction, sort, compaction. How far (section 3.2 adds one step after the other) and who finds
// the pages in what is left, the device or the host, can be chosen. The host reads the counts, as the paper's does.
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

/// Which steps thin the list before it is used; each takes those before it along.
enum class Uniquify { none, components, compact, full };

struct RequestListDesc {
  uint32_t width = 0, height = 0;  ///< of the image
  uint32_t levels = 1;             ///< at which a pixel asks for a page
  uint32_t pages = 0;              ///< their numbers are below
  Uniquify uniquify = Uniquify::full;
  bool on_host = false;  ///< the host makes unique what is left
  bool edges = false;    ///< only pixels on coarse shadows' edges ask
  vk::DescriptorSetLayout lookup_layout;
  uint32_t light_kind = shared::light_any;
};

/// Lengths of the list on its way; 0 for what is not known because the step was left out.
struct RequestCounts {
  uint32_t listed = 0;     ///< entries that are used, of a list that is not compacted with its gaps
  uint32_t compacted = 0;  ///< requests left by the first compaction: what is sorted
  uint32_t unique = 0;     ///< left by the second, or by the host
};

class RequestList {
 public:
  RequestList() = default;
  RequestList(const gpu::Device& device, const RequestListDesc& desc);
  /// Whether the list for an image of this size is small enough to be bound.
  static bool serves(uint32_t width, uint32_t height, uint32_t levels);

  /// Fills the list from the receivers, and marks what it has no room for. Submits and waits.
  void find(const ReceiverLookup& lookup, const RequestMasks& masks, gpu::Recorder& recorder);
  /// Marks the list's pages in the masks.
  void mark(const vk::raii::CommandBuffer& commands, const gpu::Buffer& constants, const RequestMasks& masks) const;

  explicit operator bool() const { return capacity_ > 0; }
  /// Of the list that was found last.
  const RequestCounts& counts() const { return counts_; }
  std::vector<Allocation> allocations() const;

 private:
  /// Where the thinned list stands.
  const gpu::Buffer& thinned() const;
  void list(const ReceiverLookup& lookup, const RequestMasks& masks, gpu::Recorder& recorder) const;
  void thin(gpu::Recorder& recorder);
  /// Hands the list to the host, which leaves each page once.
  void make_unique_on_host(gpu::Recorder& recorder);
  uint32_t read_count(const std::function<void(const vk::raii::CommandBuffer&)>& compact, uint32_t of,
                      const char* stage, gpu::Recorder& recorder) const;

  RequestListDesc desc_;
  uint32_t capacity_ = 0;
  RequestCounts counts_;
  gpu::ComputePass list_pass_, components_pass_, mark_pass_;
  gpu::Compaction compaction_;
  gpu::RadixSort sort_;
  gpu::Buffer requests_, kept_, count_;
  gpu::Buffer on_host_;         ///< read and written by the host while no frame is under way
  std::vector<uint32_t> seen_;  ///< a bit a page
};

}  // namespace shadewright::shadow
