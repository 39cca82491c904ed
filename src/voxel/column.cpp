#include "column.h"

#include <algorithm>

namespace shadewright::voxel {

void stack_slabs(DagBuilder& builder, const Column& leaves, Column& result) {
  result.clear();
  const uint32_t end = leaves.back().end / 8;
  size_t run = 0;
  for (uint32_t slab = 0; slab < end;) {
    while (leaves[run].end <= slab * 8) ++run;
    const Value value = leaves[run].value;
    std::array<Value, 8> slabs;
    if (leaves[run].end >= slab * 8 + 8) {
      slabs.fill(value);
      slab = leaves[run].end / 8;
    } else {
      for (uint32_t i = 0; i < 8; ++i) {
        while (leaves[run].end <= slab * 8 + i) ++run;
        slabs[i] = leaves[run].value;
      }
      ++slab;
    }
    append(result, slab, builder.slab_node(slabs));
  }
}

void join_columns(DagBuilder& builder, uint32_t height, const std::array<const Column*, 4>& parts, Column& result) {
  result.clear();
  const uint32_t end = parts[0]->back().end / 2;
  std::array<const Run*, 4> run;
  for (size_t i = 0; i < 4; ++i) run[i] = parts[i]->data();
  for (uint32_t slab = 0; slab < end;) {
    std::array<Value, 8> octants;
    uint32_t alike = end;  // all slabs up to here have these octants
    for (size_t i = 0; i < 4; ++i) {
      while (run[i]->end <= slab * 2) ++run[i];
      octants[i] = run[i]->value;
      octants[i + 4] = run[i]->end > slab * 2 + 1 ? run[i]->value : run[i][1].value;
      alike = std::min(alike, run[i]->end / 2);
    }
    slab = std::max(alike, slab + 1);
    const bool uniform = !is_node(octants[0]) &&
                         std::all_of(octants.begin() + 1, octants.end(), [&](Value v) { return v == octants[0]; });
    append(result, slab, uniform ? octants[0] : builder.octant_node(height, octants));
  }
}

void flat_column(DagBuilder& builder, uint32_t height, const FlatCut& cut, Column& result) {
  result.clear();
  const uint32_t end = 1u << (builder.log2_size() - height);
  const int64_t side = int64_t(1) << height;
  const auto slab = [&](int64_t depth) { return uint32_t(std::clamp<int64_t>(depth, 0, int64_t(end))); };
  // Volumes that the cut's two depths fall into, and the uniform ones before, between and behind them.
  for (const int64_t depth : {cut.shadowed_from, cut.visible_to}) {
    const uint32_t at = slab(depth >> height);
    if (at > (result.empty() ? 0 : result.back().end)) append(result, at, builder.flat(height, (at - 1) * side, cut));
    if (at < end) append(result, at + 1, builder.flat(height, at * side, cut));
  }
  append(result, end, builder.flat(height, (end - 1) * side, cut));
}

}  // namespace shadewright::voxel
