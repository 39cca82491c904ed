// What a baked shadow consists of.
#pragma once

#include <cstdint>
#include <vector>

#include "shadewright/voxel/shadow.h"

namespace shadewright::voxel {

/// Nodes of one height of a DAG; height 0 is the leaves.
struct LevelCounts {
  uint32_t height = 0;
  double unmerged = 0;  ///< intersected nodes that the tree would have without merging, below the grid
  uint64_t merged = 0;  ///< nodes of the DAG
  uint64_t bytes = 0;
};

/// From the nodes below the grid down to the leaves; `dag` is an index of `shadow.dags()`.
std::vector<LevelCounts> count_levels(const VoxelShadow& shadow, size_t dag = 0);

}  // namespace shadewright::voxel
