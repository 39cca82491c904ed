#include "quad.h"

#include <algorithm>
#include <cmath>

namespace shadewright::voxel {

namespace {

struct EdgeRange {
  int64_t low, high;  ///< of the edge function over a box
};

EdgeRange range_over(const EdgeFunction& edge, const CenterBox& box) {
  const int64_t corner = edge.at(box.x0, box.y0), across = -edge.dy * (box.x1 - box.x0),
                down = edge.dx * (box.y1 - box.y0);
  return {corner + std::min<int64_t>(across, 0) + std::min<int64_t>(down, 0),
          corner + std::max<int64_t>(across, 0) + std::max<int64_t>(down, 0)};
}

constexpr int32_t kNever = INT32_MAX;

int32_t height_of(double sub_voxels) {
  return int32_t(std::floor(sub_voxels / kSubVoxels + 0.5));
}

/// Bounds of the triangle's height at the box's points that it covers: of its plane over the box, and of its corners.
/// Double arithmetic, widened by more than it can be wrong.
std::pair<int32_t, int32_t> height_bounds(const QuadTriangle& quad_triangle, const CenterBox& box) {
  const SnappedTriangle& t = quad_triangle.triangle;
  const glm::dvec2 slope = quad_triangle.slope;
  const int32_t low = std::min({t.corners[0].z, t.corners[1].z, t.corners[2].z});
  const int32_t high = std::max({t.corners[0].z, t.corners[1].z, t.corners[2].z});
  const glm::dvec3 a(t.corners[0]);
  const glm::dvec2 center(0.5 * double(box.x0 + box.x1) - a.x, 0.5 * double(box.y0 + box.y1) - a.y);
  const glm::dvec2 reach(0.5 * double(box.x1 - box.x0), 0.5 * double(box.y1 - box.y0));
  const double middle = a.z + glm::dot(slope, center), spread = glm::dot(glm::abs(slope), reach);
  const double slack = 1 + 1e-9 * (glm::dot(glm::abs(slope), glm::abs(center)) + spread);
  return {height_of(std::max(double(low), middle - spread - slack)),
          height_of(std::min(double(high), middle + spread + slack))};
}

}  // namespace

bool touches(const SnappedTriangle& t, const glm::ivec2& low, const glm::ivec2& high, const CenterBox& box) {
  if (high.x < box.x0 || low.x > box.x1 || high.y < box.y0 || low.y > box.y1) return false;
  if (low.x >= box.x0 && high.x <= box.x1 && low.y >= box.y0 && high.y <= box.y1) return true;
  for (int e = 0; e < 3; ++e)
    if (range_over(edge_function(t, e), box).high < 0) return false;
  return true;
}

bool silhouette_crosses(const SnappedTriangle& t, const CenterBox& box) {
  for (int e = 0; e < 3; ++e) {
    if (!(t.silhouettes >> e & 1)) continue;
    const glm::ivec3 &a = t.corners[e], &b = t.corners[(e + 1) % 3];
    if (std::max(a.x, b.x) < box.x0 || std::min(a.x, b.x) > box.x1 || std::max(a.y, b.y) < box.y0 ||
        std::min(a.y, b.y) > box.y1)
      continue;
    const EdgeRange range = range_over(edge_function(t, e), box);
    if (range.low <= 0 && range.high >= 0) return true;
  }
  return false;
}

std::optional<FlatCut> QuadBounds::decide(const Quad& quad, std::span<const QuadTriangle* const> triangles) {
  const CenterBox box(quad, rules_.reach, rules_.size);
  low_.clear(), high_.clear();
  for (const QuadTriangle* triangle : triangles) {
    const auto [low, high] = height_bounds(*triangle, box);
    low_.push_back(low), high_.push_back(high);
  }
  // A sheet's triangles meet in edges over the quad, so that their ranges of heights overlap: the first chain of
  // overlapping ranges holds the first sheet, whole. If no silhouette edge of the chain crosses the quad, its sheets
  // cover all texels.
  const size_t count = triangles.size();
  const int32_t first_min = *std::min_element(low_.begin(), low_.end());
  int32_t first_max = first_min;
  for (int32_t before = kNever; before != first_max;) {
    before = first_max;
    for (size_t i = 0; i < count; ++i) first_max = low_[i] <= before ? std::max(first_max, high_[i]) : first_max;
  }
  bool enters = false, leaves = false, open = false;
  int32_t next_entry = kNever, next_exit = kNever, next = kNever;  // lowest bounds behind the chain
  for (size_t i = 0; i < count; ++i) {
    const Crossing crossing = triangles[i]->triangle.crossing;
    if (low_[i] <= first_max) {
      if (triangles[i]->triangle.silhouettes != 0 && silhouette_crosses(triangles[i]->triangle, box))
        return std::nullopt;
      enters |= crossing == Crossing::enters, leaves |= crossing == Crossing::leaves,
          open |= crossing == Crossing::open;
    } else {
      next = std::min(next, low_[i]);
      if (crossing == Crossing::enters) next_entry = std::min(next_entry, low_[i]);
      if (crossing == Crossing::leaves) next_exit = std::min(next_exit, low_[i]);
    }
  }
  int32_t limit_min = first_min;
  // The counter cannot return to zero before the first surface of the other kind.
  if (enters && !leaves && !open) limit_min = next_exit;
  if (leaves && !enters && !open) limit_min = next_entry;
  if (rules_.static_receivers && enters + leaves + open == 1) {
    // Each sheet covers each texel once: one texel tells how many sheets the chain has.
    const int64_t px = texel_center(quad.x + quad.side() / 2), py = texel_center(quad.y + quad.side() / 2);
    int sheets = 0;
    for (size_t i = 0; i < count; ++i) sheets += low_[i] <= first_max && covers(triangles[i]->triangle, px, py);
    if (sheets == 1) limit_min = std::max(limit_min, next);
  }
  if (limit_min != kNever) limit_min = std::max(limit_min - rules_.margin, first_min);
  const FlatCut cut{std::clamp(first_max, 0, rules_.depth), std::clamp(limit_min, 0, rules_.depth)};
  if (cut.shadowed_from > cut.visible_to) return std::nullopt;
  return cut;
}

}  // namespace shadewright::voxel
