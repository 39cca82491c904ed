// The sampling rule, exactly: which texel centres a snapped triangle covers, and its depth there in voxels.
// Texel (i, j) is sampled at its centre, (i + 0.5, j + 0.5) texels. A centre on an edge belongs to the triangle if the
// edge is a top or a left one, so that neighbours neither share nor lose a texel.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>

#include "snapped.h"

namespace shadewright::voxel {

__extension__ using Int128 = __int128;

/// x and y of texel i's centre, in sub-voxels.
inline int64_t texel_center(int64_t i) {
  return i * kSubVoxels + kSubVoxels / 2;
}

/// Twice the area of (a, b, p), positive when p is inside of edge ab.
struct EdgeFunction {
  int64_t x = 0, y = 0;    ///< the edge's first corner
  int64_t dx = 0, dy = 0;  ///< to the second
  int64_t least = 0;       ///< inside from this value on: 0 for top and left edges, else 1

  EdgeFunction() = default;
  EdgeFunction(const glm::ivec3& a, const glm::ivec3& b)
      : x(a.x), y(a.y), dx(int64_t(b.x) - a.x), dy(int64_t(b.y) - a.y), least(dy < 0 || (dy == 0 && dx > 0) ? 0 : 1) {}
  int64_t at(int64_t px, int64_t py) const { return dx * (py - y) - dy * (px - x); }
};

/// Edge e runs from corner e to corner e + 1.
inline EdgeFunction edge_function(const SnappedTriangle& t, int e) {
  return {t.corners[e], t.corners[(e + 1) % 3]};
}

inline bool covers(const SnappedTriangle& t, int64_t px, int64_t py) {
  for (int e = 0; e < 3; ++e) {
    const EdgeFunction edge = edge_function(t, e);
    if (edge.at(px, py) < edge.least) return false;
  }
  return true;
}

inline Int128 floor_divide(Int128 a, Int128 b) {
  return a / b - (a % b != 0 && (a < 0) != (b < 0) ? 1 : 0);
}

/// How many voxels lie before the triangle's plane at (px, py): the number of z with z + 0.5 <= depth (may be
/// negative). Voxel z is visible past no surface but this iff z < height.
inline int64_t exact_height(const SnappedTriangle& t, int64_t px, int64_t py) {
  const int64_t w2 = edge_function(t, 0).at(px, py), w0 = edge_function(t, 1).at(px, py),
                w1 = edge_function(t, 2).at(px, py);
  const Int128 area = Int128(w0) + w1 + w2;
  const Int128 depth = Int128(w0) * t.corners[0].z + Int128(w1) * t.corners[1].z + Int128(w2) * t.corners[2].z;
  return int64_t(floor_divide(depth + area * (kSubVoxels / 2), area * kSubVoxels));
}

/// How much a triangle's plane rises in z along x and along y; both rounded twice (the integers below are exact:
/// coordinates stay within the guard).
inline glm::dvec2 gradient(const SnappedTriangle& t) {
  const glm::i64vec3 u = glm::i64vec3(t.corners[1]) - glm::i64vec3(t.corners[0]);
  const glm::i64vec3 v = glm::i64vec3(t.corners[2]) - glm::i64vec3(t.corners[0]);
  const double area = double(u.x * v.y - u.y * v.x);
  return {double(u.z * v.y - v.z * u.y) / area, double(v.z * u.x - u.z * v.x) / area};
}

/// The height where nothing is hit.
inline constexpr int32_t kNoHit = INT32_MAX;

/// What decides a texel's voxels: z < first is visible; from limit on shadowed; undefined between.
struct TexelRange {
  int32_t first = kNoHit, limit = kNoHit;
  /// What guards filters: a receiver in shadow over this texel, moved along its normal, is at `limit` less the margin
  /// or deeper, and either nearer than `next`, where the next body (static: surface) begins, or at `next_limit`, where
  /// that one ends, less the margin or deeper. A neighbour whose own first surface is at `next` or behind is not inside
  /// its body at any depth before `next`: only `next_limit` bounds its undefined region. So where a silhouette's
  /// background goes on in its shadow, the background keeps its freedom.
  int32_t next = kNoHit, next_limit = kNoHit;
};

/// Margin below `limit` under filters: m = 0.36 kmax max(tx, ty) + tz, in voxels of z, rounded up (formulas.md). 0.36
/// is what the receiver's offset along its normal, kmax/2 (tx |nx| + ty |ny|), can take away from its depth.
int32_t filter_margin(const LightGrid& grid, uint32_t max_filter);

}  // namespace shadewright::voxel
