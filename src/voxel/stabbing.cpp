#include "stabbing.h"

#include <algorithm>
#include <bit>
#include <vector>

namespace shadewright::voxel {

namespace {

BlockRange unite(const BlockRange& a, const BlockRange& b) {
  return {std::max(a.first_max, b.first_max), std::min(a.limit_min, b.limit_min)};
}

bool one_cut(const BlockRange& range) {
  return range.first_max <= range.limit_min;
}

/// Texel t (row by row) of the block-th 8 x 8 square of a tile.
uint32_t texel_of(uint32_t block, uint32_t t) {
  return ((block / 4) * 8 + t / 8) * kTileSide + (block % 4) * 8 + t % 8;
}

}  // namespace

int64_t best_aligned(int64_t low, int64_t high) {
  if (low <= 0) return 0;
  // The highest bit in which low - 1 and high differ is set in high, clear in low - 1: cut high below it.
  const int bit = 63 - std::countl_zero(uint64_t(low - 1) ^ uint64_t(high));
  return high >> bit << bit;
}

FlatCut choose_cut(Resolving resolving, const FlatCut& range) {
  if (resolving == Resolving::paper) return range;
  const int64_t depth = best_aligned(range.shadowed_from, range.visible_to);
  return {depth, depth};
}

void TileColumns::build(const TileRanges& ranges, Column& result) {
  block_ranges(ranges.first.data(), ranges.limit.data(), blocks_);
  BlockRange all = blocks_[0];
  for (const BlockRange& block : blocks_) all = unite(all, block);
  if (one_cut(all))
    return flat_column(builder_, kLog2Tile, choose_cut(resolving_, {all.first_max, all.limit_min}), result);
  for (uint32_t i = 0; i < 4; ++i) quarter(ranges, i & 1, i >> 1, quarters_[i]);
  join_columns(builder_, kLog2Tile, {&quarters_[0], &quarters_[1], &quarters_[2], &quarters_[3]}, result);
}

void TileColumns::quarter(const TileRanges& ranges, uint32_t x, uint32_t y, Column& result) {
  const uint32_t first = y * 8 + x * 2;
  const BlockRange all =
      unite(unite(blocks_[first], blocks_[first + 1]), unite(blocks_[first + 4], blocks_[first + 5]));
  if (one_cut(all)) return flat_column(builder_, 4, choose_cut(resolving_, {all.first_max, all.limit_min}), result);
  for (uint32_t i = 0; i < 4; ++i) square(ranges, first + (i & 1) + (i >> 1) * 4, squares_[i]);
  join_columns(builder_, 4, {&squares_[0], &squares_[1], &squares_[2], &squares_[3]}, result);
}

void TileColumns::square(const TileRanges& ranges, uint32_t block, Column& result) {
  const BlockRange& all = blocks_[block];
  if (one_cut(all))
    return flat_column(builder_, kSlabHeight, choose_cut(resolving_, {all.first_max, all.limit_min}), result);
  ++stabbed_;
  leaves_.clear();
  if (resolving_ == Resolving::stabbed)
    stab(ranges, block);
  else
    follow_paper(ranges, block);
  stack_slabs(builder_, leaves_, result);
}

void TileColumns::stab(const TileRanges& ranges, uint32_t block) {
  std::array<Stab, 64> stabs;
  const uint32_t count = stab_block(&ranges.first[texel_of(block, 0)], &ranges.limit[texel_of(block, 0)], stabs);
  uint64_t visible = ~uint64_t(0);
  for (uint32_t i = 0; i < count; ++i) {
    append(leaves_, uint32_t(best_aligned(stabs[i].low, stabs[i].high)), builder_.leaf(visible));
    visible &= ~stabs[i].texels;
  }
  append(leaves_, 1u << builder_.log2_size(), kAllShadowed);
}

void TileColumns::follow_paper(const TileRanges& ranges, uint32_t block) {
  std::vector<int32_t> depths;
  for (uint32_t t = 0; t < 64; ++t) {
    depths.push_back(ranges.first[texel_of(block, t)]);
    depths.push_back(ranges.limit[texel_of(block, t)]);
  }
  std::sort(depths.begin(), depths.end());
  depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
  int32_t from = 0;
  for (const int32_t depth : depths) {
    uint64_t visible = 0, shadowed = 0;
    for (uint32_t t = 0; t < 64; ++t) {
      visible |= uint64_t(from < ranges.first[texel_of(block, t)]) << t;
      shadowed |= uint64_t(from >= ranges.limit[texel_of(block, t)]) << t;
    }
    if (depth > from) append(leaves_, uint32_t(depth), builder_.resolved_leaf(visible, shadowed));
    from = depth;
  }
  append(leaves_, 1u << builder_.log2_size(), kAllShadowed);
}

}  // namespace shadewright::voxel
