// The vector loops of a tile (Highway, widest vectors of the CPU at run time). All of them work on rows of kTileStride
// texels.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "snapped.h"

namespace shadewright::voxel {

/// Texels a row of a tile's layer: the tile, and 8 to either side for the widest filter. Also the most rows.
inline constexpr uint32_t kTileStride = 48;

using TileRows = std::array<uint64_t, kTileStride>;                  ///< bit i of [j]: texel (i, j)
using TileHeights = std::array<int32_t, kTileStride * kTileStride>;  ///< row by row

/// Heights of a plane in double: base + x * i + y * j for texel (i, j), each wrong by less than `error`.
struct HeightPlane {
  double base = 0, x = 0, y = 0, error = 0;
};

/// Writes floor(plane) at all texels of `rows`, and returns in `uncertain` those where the error may change the result.
void fill_heights(const HeightPlane& plane, const TileRows& rows, uint32_t first_row, uint32_t end_row,
                  int32_t* heights, TileRows& uncertain);

struct LayerView {
  const int32_t* heights;
  int32_t count;  ///< what a crossing adds to the entry counter: 1, -1, or 0 for open surfaces
};

/// The members of `TexelRange`, each kTileStride rows of a tile.
struct RangeRows {
  int32_t *first, *limit, *next, *next_limit;
};

/// What `range_of_crossings` finds, of all texels of `row_count` rows, when nothing is known of crossings from
/// `rest_from` on: no range ends later, and no next body begins there.
void resolve_layers(std::span<const LayerView> layers, uint32_t row_count, bool static_receivers, int32_t rest_from,
                    const RangeRows& ranges);

/// Minimum over windows of (2 reach + 1)²: result (i, j) is of the window with its lowest corner at (i, j). Needs, and
/// spoils, `values`; rows beyond row_count - 2 reach and columns beyond kTileStride - 2 reach are unspecified.
void window_minimum(int32_t* values, uint32_t row_count, uint32_t reach);

/// The guard of `TexelRange` for the texels to which the minimum of all limits leaves no freedom (it is the safe bound,
/// and the full rule takes a look at every neighbour). `least` holds that minimum for the tile's texels, rows
/// kTileStride long, and is raised.
void raise_pinned(const RangeRows& ranges, uint32_t reach, int32_t margin, int32_t* least);

/// What all texels of a square share: visible before `limit_min`, shadowed from `first_max` on.
struct BlockRange {
  int32_t first_max, limit_min;
};

/// Of the sixteen 8 x 8 squares, row by row, of a tile of 32 x 32 texels.
void block_ranges(const int32_t* first, const int32_t* limit, std::array<BlockRange, 16>& blocks);

/// A depth in [low, high] that lies in the ranges of `texels`.
struct Stab {
  int32_t low, high;
  uint64_t texels;  ///< bit 8 y + x
};

/// The fewest depths that pierce the ranges [first, limit] of all texels of an 8 x 8 square of a tile, nearest first;
/// returns their number. Pointers are to the square's first texel.
uint32_t stab_block(const int32_t* first, const int32_t* limit, std::array<Stab, 64>& stabs);

}  // namespace shadewright::voxel
