// All volumes of one height above one another, run by run: most of them are alike along z in light space (CPVS, figure
// 2), and are built once.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dag_builder.h"
#include "value.h"

namespace shadewright::voxel {

struct Run {
  uint32_t end = 0;  ///< one past the last volume of the run, counted from the light in volumes of the column's height
  Value value = kAllVisible;
};

/// Runs in order of z, without gaps.
using Column = std::vector<Run>;

/// Adds volumes up to `end`, joined to the last run if that is alike. Does nothing if the column reaches there already.
inline void append(Column& column, uint32_t end, Value value) {
  if (!column.empty() && column.back().end >= end) return;
  if (!column.empty() && column.back().value == value)
    column.back().end = end;
  else
    column.push_back({end, value});
}

/// Single voxels' slabs (runs of leaves) to slab nodes.
void stack_slabs(DagBuilder& builder, const Column& leaves, Column& result);

/// Four columns beside one another (x | y << 1) of height `height` - 1 to one of nodes of height `height` > 3.
void join_columns(DagBuilder& builder, uint32_t height, const std::array<const Column*, 4>& parts, Column& result);

/// The column of a quad of height `height` that is cut alike at all its texels.
void flat_column(DagBuilder& builder, uint32_t height, const FlatCut& cut, Column& result);

}  // namespace shadewright::voxel
