// From ranges of depths to a column of the DAG. Any height field within the ranges is right (formulas.md "The smallest
// result is a freer problem"); this chooses one with few and well aligned steps: wherever one depth serves a whole
// square, that, and elsewhere in each 8 x 8 square the fewest depths that pierce all 64 ranges (greedy interval
// stabbing).
#pragma once

#include <cstdint>

#include "column.h"
#include "shadewright/voxel/bake.h"
#include "tile.h"

namespace shadewright::voxel {

/// The number in [low, high] that the highest power of two divides.
int64_t best_aligned(int64_t low, int64_t high);

/// One depth for a volume whose texels may all be cut anywhere in [shadowed_from, visible_to]; with the paper's rule
/// both stay.
FlatCut choose_cut(Resolving resolving, const FlatCut& range);

class TileColumns {
 public:
  TileColumns(DagBuilder& builder, Resolving resolving) : builder_(builder), resolving_(resolving) {}
  /// The column of height 5 over a tile.
  void build(const TileRanges& ranges, Column& result);
  /// Squares that needed more than one depth so far.
  uint64_t stabbed() const { return stabbed_; }

 private:
  void quarter(const TileRanges& ranges, uint32_t x, uint32_t y, Column& result);
  void square(const TileRanges& ranges, uint32_t block, Column& result);
  void stab(const TileRanges& ranges, uint32_t block);
  void follow_paper(const TileRanges& ranges, uint32_t block);

  DagBuilder& builder_;
  Resolving resolving_;
  uint64_t stabbed_ = 0;
  std::array<BlockRange, 16> blocks_;
  Column leaves_;
  std::array<Column, 4> squares_, quarters_;
};

}  // namespace shadewright::voxel
