// Exact first depth and end of the undefined region for a square of 32 x 32 texels, by rasterizing its triangles into
// layers and counting entries and exits over all of them (CPVS, section 6.1, without depth peeling).
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "quad_triangle.h"
#include "sampling.h"
#include "snapped.h"
#include "tile_simd.h"

namespace shadewright::voxel {

inline constexpr uint32_t kLog2Tile = 5, kTileSide = 1u << kLog2Tile;

struct TileRules {
  int32_t size = 0;    ///< texels of the map per axis
  uint32_t reach = 0;  ///< max_filter / 2
  int32_t margin = 0;  ///< `filter_margin`
  int32_t depth = 0;   ///< voxels in z
  bool static_receivers = false;
};

/// z < first: visible; z >= limit: shadowed. Row by row, 0 <= first <= limit <= depth.
struct TileRanges {
  alignas(64) std::array<int32_t, kTileSide * kTileSide> first, limit;
};

/// Scratch memory that is kept from tile to tile.
class TileRasterizer {
 public:
  explicit TileRasterizer(const TileRules& rules) : rules_(rules) {}
  /// Texels [x, x + 32) x [y, y + 32). `triangles` holds at least all that cover a texel centre of the tile widened by
  /// `reach`; each one's heights there lie in [lows, highs]. Triangles behind depths at which every texel is covered
  /// are not looked at: where the undefined region does not end before them, `limit` is where they begin.
  void rasterize(std::span<const QuadTriangle* const> triangles, std::span<const int32_t> lows,
                 std::span<const int32_t> highs, int32_t x, int32_t y, TileRanges& ranges);

 private:
  /// Triangles of one kind that do not overlap.
  struct Layer {
    Crossing crossing = Crossing::open;
    TileRows rows;
    alignas(64) TileHeights heights;  ///< kNoHit where no triangle is
  };

  uint32_t side() const { return kTileSide + 2 * rules_.reach; }
  bool find_rows(const QuadTriangle& triangle, int32_t x, int32_t y);
  Layer& layer_for(Crossing crossing);
  void draw(const QuadTriangle& triangle, int32_t x, int32_t y, Layer& layer);
  bool all_covered() const;

  TileRules rules_;
  std::deque<Layer> layers_;
  size_t used_layers_ = 0;
  std::vector<std::pair<int32_t, uint32_t>> order_;  ///< lower bound of height, triangle
  std::vector<LayerView> views_;
  TileRows rows_{};  ///< of the triangle being drawn, with its range of rows
  uint32_t first_row_ = 0, end_row_ = 0;
  alignas(64) TileHeights first_, limit_, next_, next_limit_, guard_;
};

}  // namespace shadewright::voxel
