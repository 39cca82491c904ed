#include "scene/builtin/shapes/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace shadewright::builtin {
namespace {

/// Direction of the path at point i: the mean of its two spans.
glm::dvec3 tangent(std::span<const glm::dvec3> path, size_t i, bool loops) {
  const size_t n = path.size();
  const glm::dvec3 before = i > 0 ? path[i] - path[i - 1] : (loops ? path[0] - path[n - 1] : path[1] - path[0]);
  const glm::dvec3 after =
      i + 1 < n ? path[i + 1] - path[i] : (loops ? path[0] - path[n - 1] : path[n - 1] - path[n - 2]);
  return glm::normalize(glm::normalize(before) + glm::normalize(after));
}

glm::dvec3 reflect(const glm::dvec3& v, const glm::dvec3& normal) {
  const double square = glm::dot(normal, normal);
  return square < 1e-30 ? v : v - (2 * glm::dot(v, normal) / square) * normal;
}

}  // namespace

Mesh sweep(std::span<const glm::dvec2> section, std::span<const glm::dvec3> path, std::span<const glm::dvec2> sizes,
           const glm::dvec3& up, Ends ends) {
  const bool loops = ends == Ends::joined;
  glm::dvec3 t = tangent(path, 0, loops);
  const glm::dvec3 helper = glm::length(glm::cross(t, up)) > 1e-3 * glm::length(up) ? up : glm::dvec3(t.z, t.x, t.y);
  glm::dvec3 y = glm::normalize(helper - glm::dot(helper, t) * t);
  std::vector<Ring> rings;
  for (size_t i = 0; i < path.size(); ++i) {
    if (i > 0) {
      const glm::dvec3 step = path[i] - path[i - 1];
      const glm::dvec3 next = tangent(path, i, loops);
      const glm::dvec3 y_mirrored = reflect(y, step), t_mirrored = reflect(t, step);
      y = reflect(y_mirrored, next - t_mirrored);
      t = next;
      y = glm::normalize(y - glm::dot(y, t) * t);
    }
    const glm::dvec3 x = glm::cross(y, t);  // x x y = t: counter-clockwise seen from where the path goes
    Ring& ring = rings.emplace_back();
    if (sizes[i].x <= 0) {
      ring.push_back(path[i]);
      continue;
    }
    for (const glm::dvec2& p : section) ring.push_back(path[i] + p.x * sizes[i].x * x + p.y * sizes[i].y * y);
  }
  return loft(rings, ends);
}

std::vector<glm::dvec2> regular_polygon(uint32_t sides) {
  std::vector<glm::dvec2> result;
  for (uint32_t j = 0; j < sides; ++j) {
    const double angle = 2 * std::numbers::pi * j / sides;
    result.emplace_back(std::cos(angle), std::sin(angle));
  }
  return result;
}

Mesh tube(std::span<const glm::dvec3> path, double radius, uint32_t sides, Ends ends) {
  return sweep(regular_polygon(sides), path, Sizes(path.size(), glm::dvec2(radius)), {0, 1, 0}, ends);
}

Mesh tapered_tube(std::span<const glm::dvec3> path, double radius, double end_radius, uint32_t sides) {
  Sizes sizes;
  for (size_t i = 0; i < path.size(); ++i) {
    const double t = double(i) / double(path.size() - 1);
    sizes.emplace_back(glm::dvec2((1 - t) * radius + t * end_radius));
  }
  return sweep(regular_polygon(sides), path, sizes);
}

Mesh rod(const glm::dvec3& a, const glm::dvec3& b, double radius, uint32_t sides) {
  return tube(std::array{a, b}, radius, sides);
}

Path smooth_path(std::span<const glm::dvec3> points, uint32_t steps) {
  Path result;
  const size_t last = points.size() - 1;
  for (size_t i = 0; i < last; ++i) {
    const glm::dvec3 a = points[i == 0 ? 0 : i - 1], b = points[i], c = points[i + 1],
                     d = points[std::min(i + 2, last)];
    for (uint32_t k = 0; k < steps; ++k) {
      const double t = double(k) / steps;
      result.push_back(0.5 *
                       (2.0 * b + t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))));
    }
  }
  result.push_back(points[last]);
  return result;
}

}  // namespace shadewright::builtin
