// A square of texels, the triangles over it, and what bounds can say of it without looking at single texels.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dag_builder.h"
#include "quad_triangle.h"
#include "snapped.h"
#include "tile.h"

namespace shadewright::voxel {

/// Texels [x, x + side) x [y, y + side) with side = 2^height.
struct Quad {
  uint32_t height = 0;
  int32_t x = 0, y = 0;

  int32_t side() const { return int32_t(1) << height; }
  Quad quarter(uint32_t i) const {
    const int32_t half = side() / 2;
    return {height - 1, x + int32_t(i & 1) * half, y + int32_t(i >> 1) * half};
  }
};

/// The sub-voxel box of the texel centres of a quad widened by `reach` texels, closed. It ends with the map of `size`
/// texels: casters wholly outside the map were dropped, and with them silhouettes that lie there.
struct CenterBox {
  int64_t x0, y0, x1, y1;

  CenterBox(const Quad& quad, uint32_t reach, int32_t size)
      : x0(texel_center(std::max(quad.x - int64_t(reach), int64_t(0)))),
        y0(texel_center(std::max(quad.y - int64_t(reach), int64_t(0)))),
        x1(texel_center(std::min(quad.x + int64_t(quad.side()) + reach, int64_t(size)) - 1)),
        y1(texel_center(std::min(quad.y + int64_t(quad.side()) + reach, int64_t(size)) - 1)) {}
};

/// Whether a triangle, as a closed set, touches the box (exact).
bool touches(const SnappedTriangle& triangle, const glm::ivec2& low, const glm::ivec2& high, const CenterBox& box);

/// Whether one of the triangle's silhouette edges touches the box (exact).
bool silhouette_crosses(const SnappedTriangle& triangle, const CenterBox& box);

/// Heights between which a quad's triangles lie, triangle by triangle, and what follows from them for the quad.
class QuadBounds {
 public:
  explicit QuadBounds(const TileRules& rules) : rules_(rules) {}
  /// The cut that serves all texels of a quad, if bounds can tell. `triangles` are all that touch the widened quad's
  /// centres.
  std::optional<FlatCut> decide(const Quad& quad, std::span<const QuadTriangle* const> triangles);
  /// The lower bounds of the last call, triangle by triangle.
  std::span<const int32_t> lows() const { return low_; }
  std::span<const int32_t> highs() const { return high_; }

 private:
  TileRules rules_;
  std::vector<int32_t> low_, high_;
};

}  // namespace shadewright::voxel
