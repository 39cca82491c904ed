#include "scene/builtin/shapes/box.h"

#include <array>
#include <cmath>

#include "scene/builtin/shapes/loft.h"

namespace shadewright::builtin {
namespace {

/// Counter-clockwise seen from +Y.
Ring rectangle(const glm::dvec2& min, const glm::dvec2& max, double y) {
  return {{min.x, y, min.y}, {min.x, y, max.y}, {max.x, y, max.y}, {max.x, y, min.y}};
}

}  // namespace

Mesh box(const glm::dvec3& min, const glm::dvec3& max) {
  const glm::dvec2 low(min.x, min.z), high(max.x, max.z);
  return loft(std::array{rectangle(low, high, min.y), rectangle(low, high, max.y)});
}

Mesh slab(const glm::dvec3& min, const glm::dvec3& max, double bevel) {
  const glm::dvec2 low(min.x, min.z), high(max.x, max.z);
  return loft(std::array{rectangle(low, high, min.y), rectangle(low, high, max.y - bevel),
                         rectangle(low + bevel, high - bevel, max.y)});
}

Mesh tapered_box(const glm::dvec2& bottom_half, const glm::dvec2& top_half, double height) {
  return loft(std::array{rectangle(-bottom_half, bottom_half, 0), rectangle(-top_half, top_half, height)});
}

Mesh beam(const glm::dvec3& a, const glm::dvec3& b, double width, double height) {
  const glm::dvec3 axis = glm::normalize(b - a);
  const glm::dvec3 helper = std::abs(axis.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 across = 0.5 * width * glm::normalize(glm::cross(axis, helper));
  const glm::dvec3 up = 0.5 * height * glm::normalize(glm::cross(across, axis));
  const auto end = [&](const glm::dvec3& c) {
    return Ring{c - across - up, c + across - up, c + across + up, c - across + up};
  };
  // across x up points against the axis, so the ring above is clockwise seen from the end: start at b.
  return loft(std::array{end(b), end(a)});
}

}  // namespace shadewright::builtin
