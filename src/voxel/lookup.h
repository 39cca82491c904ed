// Walking the DAG, one voxel at a time (CPVS, section 6.2). The batch look-up does the same for many points at once.
#pragma once

#include <cstdint>

#include "shadewright/voxel/dag.h"

namespace shadewright::voxel {

/// The 8 x 8 voxels of depth z around texel (x, y), as a leaf mask. All three lie inside the volume.
inline uint64_t find_leaf(const DagView& dag, uint32_t x, uint32_t y, uint32_t z) {
  uint32_t height = dag.log2_size - dag.log2_grid;
  uint32_t at = dag.grid[((z >> height) << 2 * dag.log2_grid) + ((y >> height) << dag.log2_grid) + (x >> height)];
  if (at <= kVisible) return 0 - uint64_t(at);
  for (; height > kSlabHeight; --height) {
    const uint32_t bit = height - 1;
    const uint32_t child = (x >> bit & 1) | (y >> bit & 1) << 1 | (z >> bit & 1) << 2;
    const uint32_t header = dag.nodes[at], code = child_code(header, child);
    if (code < kOwnPointer) return 0 - uint64_t(code);
    at = dag.nodes[at + 1 + pointer_index(header, child, true)];
  }
  const uint32_t header = dag.nodes[at], code = child_code(header, z & 7);
  if (code < kOwnPointer) return 0 - uint64_t(code);
  return dag.leaves[dag.nodes[at + 1 + pointer_index(header, z & 7, false)]];
}

inline bool find_voxel(const DagView& dag, uint32_t x, uint32_t y, uint32_t z) {
  return find_leaf(dag, x, y, z) >> ((y & 7) * 8 + (x & 7)) & 1;
}

/// The bits of a leaf at texels (leaf_x, leaf_y) * 8 that lie in [x0, x1] x [y0, y1] (figure 6).
inline uint64_t filter_mask(int32_t leaf_x, int32_t leaf_y, int32_t x0, int32_t x1, int32_t y0, int32_t y1) {
  const int32_t left = x0 - 8 * leaf_x > 0 ? x0 - 8 * leaf_x : 0, right = x1 - 8 * leaf_x < 7 ? x1 - 8 * leaf_x : 7;
  const int32_t top = y0 - 8 * leaf_y > 0 ? y0 - 8 * leaf_y : 0, bottom = y1 - 8 * leaf_y < 7 ? y1 - 8 * leaf_y : 7;
  const uint64_t row = (0xffu >> (7 - right)) & (0xffu << left);
  const uint64_t rows = (~uint64_t(0) >> (8 * (7 - bottom))) & (~uint64_t(0) << (8 * top));
  return row * 0x0101010101010101ull & rows;
}

}  // namespace shadewright::voxel
