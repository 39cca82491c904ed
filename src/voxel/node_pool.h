// Hash-consing: equal nodes exist once (CPVS, section 3: "merging common subtrees"), from any number of threads at
// once. Which id a node gets depends on the threads' timing; the set of nodes does not. The layout renumbers them
// canonically.
#pragma once

#include <tbb/spin_mutex.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shadewright/voxel/dag.h"
#include "value.h"

namespace shadewright::voxel {

/// Counts the bytes that a bake's pools hold together, and refuses to pass a limit.
class MemoryBudget {
 public:
  explicit MemoryBudget(uint64_t limit_bytes) : limit_(limit_bytes) {}
  /// FailureError when the sum passes the limit.
  void add(uint64_t bytes);
  void remove(uint64_t bytes) { used_ -= bytes; }
  uint64_t peak() const { return peak_; }
  uint64_t limit() const { return limit_; }

 private:
  uint64_t limit_;
  std::atomic<uint64_t> used_{0}, peak_{0};
};

/// Distinct word sequences, each a header and as many words as `node_words` says. All members are thread-safe, except
/// that `words` needs every insertion to have happened before.
class NodePool {
 public:
  explicit NodePool(MemoryBudget& budget);
  /// The id of this node, new or not; its header's high half must be zero.
  uint32_t insert(std::span<const uint32_t> words);
  const uint32_t* words(uint32_t id) const { return &shards_[id % kShards].words[id / kShards]; }
  uint64_t count() const;
  /// First slot of each shard, and their end: `slot(starts, id)` numbers the words of all shards without gaps.
  std::vector<uint64_t> slot_starts() const;
  static uint64_t slot(std::span<const uint64_t> starts, uint32_t id) { return starts[id % kShards] + id / kShards; }

 private:
  static constexpr uint32_t kShards = 64;
  struct alignas(64) Shard {
    tbb::spin_mutex mutex;
    std::vector<uint32_t> words;
    std::vector<uint32_t> table;  ///< offset in words + 1; 0 = free
    uint32_t count = 0;
  };
  void grow(Shard& shard);

  MemoryBudget* budget_;
  std::unique_ptr<Shard[]> shards_;
};

/// Distinct leaf masks; 0 and ~0 never come here.
class LeafPool {
 public:
  explicit LeafPool(MemoryBudget& budget);
  uint32_t insert(uint64_t mask);
  uint64_t mask(uint32_t id) const { return shards_[id % kShards].masks[id / kShards]; }
  uint64_t count() const;
  /// As NodePool's, a slot a leaf.
  std::vector<uint64_t> slot_starts() const;
  static uint64_t slot(std::span<const uint64_t> starts, uint32_t id) { return starts[id % kShards] + id / kShards; }

 private:
  static constexpr uint32_t kShards = 64;
  struct alignas(64) Shard {
    tbb::spin_mutex mutex;
    std::vector<uint64_t> masks;
    std::vector<uint32_t> table;
  };
  void grow(Shard& shard);

  MemoryBudget* budget_;
  std::unique_ptr<Shard[]> shards_;
};

}  // namespace shadewright::voxel
