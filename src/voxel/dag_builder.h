// Makes the nodes of every height through one pool each: leaves, slab nodes (8 leaves along z), octants above.
#pragma once

#include <array>
#include <cstdint>
#include <deque>

#include "node_pool.h"
#include "value.h"

namespace shadewright::voxel {

/// A volume that may be visible up to depth `visible_to` and may be shadowed from depth `shadowed_from` on (integer
/// voxel depths that hold for all its texels). Where both may be, it is undefined.
struct FlatCut {
  int64_t shadowed_from = 0, visible_to = 0;
};

class DagBuilder {
 public:
  /// For a volume of 2^log2_size voxels per axis.
  DagBuilder(uint32_t log2_size, MemoryBudget& budget);

  uint32_t log2_size() const { return log2_size_; }
  Value leaf(uint64_t visible_mask);
  /// The leaf that is visible at `visible`, shadowed at `shadowed`, and undefined elsewhere, by the paper's rule.
  Value resolved_leaf(uint64_t visible, uint64_t shadowed);
  /// A node of 8 x 8 x 8 voxels from its 8 slabs, nearest first. Undefined slabs are resolved.
  Value slab_node(std::array<Value, 8> slabs);
  /// A node of height `height` > 3 from its octants, x | y << 1 | z << 2. Undefined octants are resolved.
  Value octant_node(uint32_t height, std::array<Value, 8> octants);
  /// The volume of height `height` >= 3 whose nearest voxels have depth `z`, cut alike at all its texels.
  /// `cut.shadowed_from` must not be greater than `cut.visible_to`.
  Value flat(uint32_t height, int64_t z, const FlatCut& cut);

  const NodePool& pool(uint32_t height) const { return pools_[height - kSlabHeight]; }
  const LeafPool& leaves() const { return leaves_; }

 private:
  Value insert(uint32_t height, std::array<Value, 8>& children);

  uint32_t log2_size_;
  LeafPool leaves_;
  std::deque<NodePool> pools_;  ///< [height - 3]; a deque, as pools do not move
};

}  // namespace shadewright::voxel
