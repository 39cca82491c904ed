// Axis-aligned boxes.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <limits>

namespace shadewright {

/// Axis-aligned box in any one space; empty when default-constructed.
struct Box {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};

  bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  glm::dvec3 center() const { return 0.5 * (min + max); }
  glm::dvec3 size() const { return max - min; }
  /// Length of the diagonal, 0 when empty.
  double diagonal() const { return empty() ? 0.0 : glm::length(size()); }

  void extend(const glm::dvec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void extend(const Box& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
  bool contains(const glm::dvec3& p) const {
    return p.x >= min.x && p.y >= min.y && p.z >= min.z && p.x <= max.x && p.y <= max.y && p.z <= max.z;
  }

  std::array<glm::dvec3, 8> corners() const {
    std::array<glm::dvec3, 8> result;
    for (size_t i = 0; i < 8; ++i)
      result[i] = {(i & 1) ? max.x : min.x, (i & 2) ? max.y : min.y, (i & 4) ? max.z : min.z};
    return result;
  }
};

/// The smallest box that holds both.
Box unite(const Box& a, const Box& b);
/// The box common to both, empty if they do not touch.
Box intersect(const Box& a, const Box& b);
/// The axis-aligned bounds of `box` under the affine map `to_from` (exact: centre and absolute half extents). Empty
/// stays empty.
Box transform(const glm::dmat4& to_from, const Box& box);

}  // namespace shadewright
