// From the builder's pools to the DAG that is kept: nodes in canonical order, the top levels as a grid, occupancy
// filled in. Nodes stand height by height, each height in the order in which a walk of the grid's cells in Morton order
// first meets them, so that the bytes depend on the shadow alone, never on threads or pool ids.
#pragma once

#include <cstdint>
#include <vector>

#include "dag_builder.h"
#include "shadewright/voxel/dag.h"

namespace shadewright::voxel {

/// A DAG that owns its memory.
struct Dag {
  uint32_t log2_size = 0, log2_grid = 0;
  std::vector<uint32_t> grid;
  std::vector<uint32_t> nodes;
  std::vector<uint64_t> leaves;
  /// Offset in `nodes` where the nodes of height log2_size - log2_grid - i begin, down to height 3, and the end.
  std::vector<uint64_t> level_starts;

  DagView view() const { return {log2_size, log2_grid, grid, nodes, leaves}; }
};

/// The grid's size for a volume: 128³ from 4,096³ voxels on, smaller below.
uint32_t grid_for(uint32_t log2_size);

/// `root` is the builder's value of the whole volume.
Dag lay_out(const DagBuilder& builder, Value root, uint32_t log2_grid);

}  // namespace shadewright::voxel
