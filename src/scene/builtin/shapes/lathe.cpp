#include "scene/builtin/shapes/lathe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/shapes/loft.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;

/// Rings about +Y, counter-clockwise seen from above.
std::vector<Ring> revolve(std::span<const glm::dvec2> profile, uint32_t segments) {
  std::vector<Ring> rings;
  for (const glm::dvec2& p : profile) {
    Ring& ring = rings.emplace_back();
    if (p.x <= 0) {
      ring.emplace_back(0, p.y, 0);
      continue;
    }
    for (uint32_t j = 0; j < segments; ++j) {
      const double angle = 2 * pi * j / segments;
      ring.emplace_back(p.x * std::cos(angle), p.y, -p.x * std::sin(angle));
    }
  }
  return rings;
}

}  // namespace

Mesh lathe(std::span<const glm::dvec2> profile, uint32_t segments) {
  return loft(revolve(profile, segments));
}

Mesh lathe_ring(std::span<const glm::dvec2> profile, uint32_t segments) {
  return loft(revolve(profile, segments), Ends::joined);
}

Profile smooth(std::span<const glm::dvec2> points, uint32_t steps) {
  Profile result;
  const size_t last = points.size() - 1;
  for (size_t i = 0; i < last; ++i) {
    const glm::dvec2 a = points[i == 0 ? 0 : i - 1], b = points[i], c = points[i + 1],
                     d = points[std::min(i + 2, last)];
    for (uint32_t k = 0; k < steps; ++k) {
      const double t = double(k) / steps;
      const glm::dvec2 p =
          0.5 * (2.0 * b + t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a))));
      result.emplace_back(std::max(p.x, 0.0), p.y);
    }
  }
  result.push_back(points[last]);
  return result;
}

Mesh sphere(double radius, uint32_t segments, uint32_t rings) {
  Profile profile;
  for (uint32_t i = 0; i <= rings; ++i) {
    const double angle = pi * (double(i) / rings - 0.5);
    profile.emplace_back(i == 0 || i == rings ? 0.0 : radius * std::cos(angle), radius * std::sin(angle));
  }
  return lathe(profile, segments);
}

Mesh cylinder(double radius, double height, uint32_t segments) {
  return cone(radius, radius, height, segments);
}

Mesh cone(double radius, double top_radius, double height, uint32_t segments) {
  return lathe(std::array{glm::dvec2(radius, 0), glm::dvec2(top_radius, height)}, segments);
}

Mesh torus(double radius, double tube_radius, uint32_t segments, uint32_t sides) {
  Profile profile;
  for (uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * pi * i / sides;
    profile.emplace_back(radius + tube_radius * std::cos(angle), tube_radius * std::sin(angle));
  }
  return lathe_ring(profile, segments);
}

Mesh pipe(double inner_radius, double outer_radius, double height, uint32_t segments) {
  return lathe_ring(std::array{glm::dvec2(outer_radius, 0), glm::dvec2(outer_radius, height),
                               glm::dvec2(inner_radius, height), glm::dvec2(inner_radius, 0)},
                    segments);
}

}  // namespace shadewright::builtin
