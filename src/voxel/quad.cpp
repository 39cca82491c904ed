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

constexpr int64_t kNever = INT64_MAX / 4;

int64_t height_of(double sub_voxels) {
  return int64_t(std::floor(sub_voxels / kSubVoxels + 0.5));
}

/// Bounds of the triangle's height at the box's points that it covers: of its plane over the box, and of its corners.
/// Double arithmetic, widened by more than it can be wrong.
std::pair<int64_t, int64_t> height_bounds(const SnappedTriangle& t, const CenterBox& box) {
  const auto [low, high] = std::minmax({t.corners[0].z, t.corners[1].z, t.corners[2].z});
  const glm::dvec3 a(t.corners[0]);
  const glm::dvec2 slope = gradient(t),
                   center(0.5 * double(box.x0 + box.x1) - a.x, 0.5 * double(box.y0 + box.y1) - a.y);
  const glm::dvec2 reach(0.5 * double(box.x1 - box.x0), 0.5 * double(box.y1 - box.y0));
  const double middle = a.z + glm::dot(slope, center), spread = glm::dot(glm::abs(slope), reach);
  const double slack = 1 + 1e-9 * (glm::dot(glm::abs(slope), glm::abs(center)) + spread);
  return {height_of(std::max(double(low), middle - spread - slack)),
          height_of(std::min(double(high), middle + spread + slack))};
}

}  // namespace

bool touches(const SnappedTriangle& t, const CenterBox& box) {
  const auto [x0, x1] = std::minmax({t.corners[0].x, t.corners[1].x, t.corners[2].x});
  const auto [y0, y1] = std::minmax({t.corners[0].y, t.corners[1].y, t.corners[2].y});
  if (x1 < box.x0 || x0 > box.x1 || y1 < box.y0 || y0 > box.y1) return false;
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

std::optional<FlatCut> QuadBounds::decide(const Quad& quad, std::span<const SnappedTriangle* const> triangles) {
  const CenterBox box(quad, rules_.reach);
  spans_.clear();
  for (const SnappedTriangle* triangle : triangles) {
    const auto [low, high] = height_bounds(*triangle, box);
    spans_.push_back({low, high, triangle});
  }
  std::sort(spans_.begin(), spans_.end(), [](const Span& a, const Span& b) { return a.low < b.low; });

  // A sheet's triangles meet in edges over the quad, so that their ranges of heights overlap: the first chain of
  // overlapping ranges holds the first sheet, whole.
  const int64_t first_min = spans_.front().low;
  int64_t first_max = spans_.front().high;
  size_t chain = 1;
  for (; chain < spans_.size() && spans_[chain].low <= first_max; ++chain)
    first_max = std::max(first_max, spans_[chain].high);
  bool alike = true;
  const Crossing crossing = spans_.front().triangle->crossing;
  for (size_t i = 1; i < chain; ++i) alike &= spans_[i].triangle->crossing == crossing;

  int64_t limit_min = first_min;
  if (alike && crossing != Crossing::open) {
    // The counter cannot return to zero before the first surface of the other kind.
    limit_min = kNever;
    for (size_t i = chain; i < spans_.size(); ++i)
      if (int(spans_[i].triangle->crossing) == -int(crossing)) {
        limit_min = spans_[i].low;
        break;
      }
  }
  if (rules_.static_receivers && alike) {
    // Each sheet covers each texel once: one texel tells how many sheets the chain has.
    const int64_t px = texel_center(quad.x + quad.side() / 2), py = texel_center(quad.y + quad.side() / 2);
    int sheets = 0;
    for (size_t i = 0; i < chain; ++i) sheets += covers(*spans_[i].triangle, px, py);
    if (sheets == 1) limit_min = std::max(limit_min, chain < spans_.size() ? spans_[chain].low : kNever);
  }
  if (limit_min != kNever) limit_min = std::max(limit_min - rules_.margin, first_min);
  const FlatCut cut{std::clamp<int64_t>(first_max, 0, rules_.depth), std::clamp<int64_t>(limit_min, 0, rules_.depth)};
  if (cut.shadowed_from > cut.visible_to) return std::nullopt;
  return cut;
}

}  // namespace shadewright::voxel
