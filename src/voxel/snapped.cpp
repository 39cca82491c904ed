#include "snapped.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

namespace shadewright::voxel {

namespace {

/// Homogeneous clip planes, inside when dot(plane, point) >= 0, a little inside the guard. The first is a spot's near
/// plane, for which `near_w` is subtracted.
std::array<glm::dvec4, 7> guard_planes() {
  const double guard = 0.99 * kGuard / kSubVoxels;
  return {glm::dvec4(0, 0, 0, 1),     glm::dvec4(1, 0, 0, guard),  glm::dvec4(-1, 0, 0, guard),
          glm::dvec4(0, 1, 0, guard), glm::dvec4(0, -1, 0, guard), glm::dvec4(0, 0, 1, guard),
          glm::dvec4(0, 0, -1, guard)};
}

int64_t signed_area(const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& c) {
  return int64_t(b.x - a.x) * (c.y - a.y) - int64_t(b.y - a.y) * (c.x - a.x);
}

/// Whether a triangle's box touches the window, in which texel centres lie half a texel inside.
bool touches_window(const SnappedTriangle& t, int32_t size) {
  const auto [x0, x1] = std::minmax({t.corners[0].x, t.corners[1].x, t.corners[2].x});
  const auto [y0, y1] = std::minmax({t.corners[0].y, t.corners[1].y, t.corners[2].y});
  return x1 >= 0 && y1 >= 0 && x0 <= size && y0 <= size;
}

class Snapper {
 public:
  Snapper(const Casters& casters, const Topology& topology, const LightGrid& grid)
      : casters_(casters), topology_(topology), grid_(grid), planes_(guard_planes()), closed_(topology.closed) {}

  SnappedCasters run() {
    snap_vertices();
    if (spot()) open_cut_bodies();
    classify();
    return emit();
  }

 private:
  static constexpr int8_t kClipped = 2;  ///< in `facing_`, beside -1, 0, 1

  bool spot() const { return grid_.kind == LightKind::spot; }

  glm::dvec4 homogeneous(uint32_t vertex) const {
    return grid_.voxel_from_world * glm::dvec4(casters_.positions[vertex], 1.0);
  }
  double distance(size_t plane, const glm::dvec4& p) const {
    return glm::dot(planes_[plane], p) - (plane == 0 ? near_w() : 0);
  }
  double near_w() const { return spot() ? grid_.near : 0.0; }

  static glm::ivec3 round(const glm::dvec4& p) {
    const glm::dvec3 sub = glm::dvec3(p) / p.w * double(kSubVoxels);
    return {int32_t(std::floor(sub.x + 0.5)), int32_t(std::floor(sub.y + 0.5)), int32_t(std::floor(sub.z + 0.5))};
  }

  void snap_vertices() {
    snapped_.resize(casters_.positions.size());
    outside_.resize(casters_.positions.size());
    tbb::parallel_for(tbb::blocked_range<size_t>(0, snapped_.size(), 16384), [&](const auto& range) {
      for (size_t v = range.begin(); v < range.end(); ++v) {
        const glm::dvec4 p = homogeneous(uint32_t(v));
        for (size_t plane = 0; plane < planes_.size(); ++plane)
          if (distance(plane, p) < 0) outside_[v] = uint8_t(outside_[v] | 1u << plane);
        if (outside_[v] == 0) snapped_[v] = round(p);
      }
    });
  }

  void open_cut_bodies() {
    std::vector<uint8_t> cut(closed_.size(), 0);  // by component
    for (size_t t = 0; t < closed_.size(); ++t)
      for (int i = 0; i < 3; ++i)
        if (outside_[casters_.triangles[t][i]] & 1) cut[topology_.component[t]] = 1;
    for (size_t t = 0; t < closed_.size(); ++t)
      if (cut[topology_.component[t]]) closed_[t] = 0;
  }

  void classify() {
    const size_t count = casters_.triangles.size();
    facing_.resize(count);
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, 16384), [&](const auto& range) {
      for (size_t t = range.begin(); t < range.end(); ++t) {
        const glm::uvec3 v = casters_.triangles[t];
        if (outside_[v.x] | outside_[v.y] | outside_[v.z]) {
          facing_[t] = kClipped;
          continue;
        }
        const int64_t area = signed_area(snapped_[v.x], snapped_[v.y], snapped_[v.z]);
        facing_[t] = int8_t((area > 0) - (area < 0));
      }
    });
  }

  /// y points down in texels: a triangle that faces the light, counter-clockwise seen from it, has negative area.
  Crossing crossing(size_t t, int64_t area) const {
    if (!closed_[t]) return Crossing::open;
    return area < 0 ? Crossing::enters : Crossing::leaves;
  }

  void add_whole(size_t t, std::vector<SnappedTriangle>& out) const {
    const glm::uvec3 v = casters_.triangles[t];
    SnappedTriangle triangle{{snapped_[v.x], snapped_[v.y], snapped_[v.z]}, Crossing::open, 0};
    if (!touches_window(triangle, int32_t(grid_.size()) * kSubVoxels)) return;
    triangle.crossing = crossing(t, facing_[t]);
    for (size_t e = 0; e < 3; ++e) {
      const uint32_t other = topology_.neighbours[3 * t + e];
      if (other == kNoTriangle || facing_[other] != facing_[t] || closed_[other] != closed_[t])
        triangle.silhouettes = uint8_t(triangle.silhouettes | 1u << e);
    }
    if (facing_[t] < 0) turn(triangle);
    out.push_back(triangle);
  }

  /// Swaps corners 1 and 2; edges (01, 12, 20) become (02, 21, 10).
  static void turn(SnappedTriangle& t) {
    std::swap(t.corners[1], t.corners[2]);
    const unsigned s = t.silhouettes;
    t.silhouettes = uint8_t((s & 2) | (s & 1) << 2 | s >> 2);
  }

  /// The part inside the guard as a fan; all its edges may border a sheet. Both triangles of an edge compute the same
  /// clipped corners, as each edge is clipped in the order of its coordinates.
  void add_clipped(size_t t, std::vector<SnappedTriangle>& out) const {
    std::vector<glm::dvec4> polygon, kept;
    for (int i = 0; i < 3; ++i) polygon.push_back(homogeneous(casters_.triangles[t][i]));
    for (size_t plane = 0; plane < planes_.size() && !polygon.empty(); ++plane) {
      kept.clear();
      for (size_t i = 0; i < polygon.size(); ++i) {
        glm::dvec4 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        double da = distance(plane, a), db = distance(plane, b);
        if (da >= 0) kept.push_back(a);
        if ((da < 0) == (db < 0)) continue;
        if (std::lexicographical_compare(&b.x, &b.x + 4, &a.x, &a.x + 4)) std::swap(a, b), std::swap(da, db);
        kept.push_back(a + (b - a) * (da / (da - db)));
      }
      polygon.swap(kept);
    }
    for (size_t i = 2; i < polygon.size(); ++i) {
      SnappedTriangle piece{{round(polygon[0]), round(polygon[i - 1]), round(polygon[i])}, Crossing::open, 7};
      const int64_t area = signed_area(piece.corners[0], piece.corners[1], piece.corners[2]);
      if (area == 0 || !touches_window(piece, int32_t(grid_.size()) * kSubVoxels)) continue;
      piece.crossing = crossing(t, area);
      if (area < 0) turn(piece);
      out.push_back(piece);
    }
  }

  SnappedCasters emit() {
    SnappedCasters result;
    const size_t count = casters_.triangles.size(), chunk = 65536, chunks = (count + chunk - 1) / chunk;
    std::vector<std::vector<SnappedTriangle>> parts(chunks);
    std::atomic<uint64_t> clipped{0};
    tbb::parallel_for(size_t(0), chunks, [&](size_t c) {
      const size_t end = std::min(count, (c + 1) * chunk);
      parts[c].reserve(end - c * chunk);
      for (size_t t = c * chunk; t < end; ++t) {
        if (facing_[t] == kClipped) {
          add_clipped(t, parts[c]);
          ++clipped;
        } else if (facing_[t] != 0) {
          add_whole(t, parts[c]);
        }
      }
    });
    size_t total = 0;
    for (const auto& part : parts) total += part.size();
    result.triangles.reserve(total);
    for (auto& part : parts) {
      result.triangles.insert(result.triangles.end(), part.begin(), part.end());
      std::vector<SnappedTriangle>().swap(part);
    }
    for (const SnappedTriangle& triangle : result.triangles) result.silhouette += triangle.silhouettes != 0;
    result.clipped = clipped;
    return result;
  }

  const Casters& casters_;
  const Topology& topology_;
  const LightGrid& grid_;
  std::array<glm::dvec4, 7> planes_;
  std::vector<glm::ivec3> snapped_;
  std::vector<uint8_t> outside_;  ///< bit p: behind planes_[p]
  std::vector<uint8_t> closed_;   ///< the topology's, without bodies that the near plane cuts
  std::vector<int8_t> facing_;
};

}  // namespace

SnappedCasters snap(const Casters& casters, const Topology& topology, const LightGrid& grid) {
  return Snapper(casters, topology, grid).run();
}

}  // namespace shadewright::voxel
