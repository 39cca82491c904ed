#include "scene/builtin/shapes/extrude.h"

#include <cmath>
#include <numeric>

namespace shadewright::builtin {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// True when p lies in the counter-clockwise triangle abc or on its edge.
bool inside(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

/// Each corner moved inwards so that every side moves by `distance`.
Polygon inset(std::span<const glm::dvec2> polygon, double distance) {
  Polygon result;
  const size_t n = polygon.size();
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec2 before = glm::normalize(polygon[i] - polygon[(i + n - 1) % n]);
    const glm::dvec2 after = glm::normalize(polygon[(i + 1) % n] - polygon[i]);
    const glm::dvec2 normal_before(-before.y, before.x), normal_after(-after.y, after.x);
    const double scale = distance / std::max(0.25, 1 + glm::dot(normal_before, normal_after));
    result.push_back(polygon[i] + scale * (normal_before + normal_after));
  }
  return result;
}

}  // namespace

std::vector<glm::uvec3> triangulate(std::span<const glm::dvec2> polygon) {
  std::vector<uint32_t> left(polygon.size());
  std::iota(left.begin(), left.end(), 0u);
  std::vector<glm::uvec3> result;
  while (left.size() > 3) {
    const size_t n = left.size();
    // The roundest ear first, so that curved outlines do not end in needles.
    size_t best = n;
    double best_quality = -1;
    for (size_t i = 0; i < n; ++i) {
      const uint32_t ia = left[(i + n - 1) % n], ib = left[i], ic = left[(i + 1) % n];
      const glm::dvec2 a = polygon[ia], b = polygon[ib], c = polygon[ic];
      const double area = cross(b - a, c - b);
      const glm::dvec2 chord = c - a;
      const double quality = area / (glm::dot(b - a, b - a) + glm::dot(c - b, c - b) + glm::dot(chord, chord));
      if (area <= 0 || quality <= best_quality) continue;
      bool empty = true;
      for (uint32_t k : left)
        if (k != ia && k != ib && k != ic && inside(polygon[k], a, b, c)) empty = false;
      if (!empty) continue;
      best = i;
      best_quality = quality;
    }
    if (best == n) break;  // not simple: what is left is no polygon
    result.emplace_back(left[(best + n - 1) % n], left[best], left[(best + 1) % n]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  result.emplace_back(left[0], left[1], left[2]);
  return result;
}

Mesh extrude(std::span<const glm::dvec2> polygon, double back, double front, double bevel) {
  Mesh mesh;
  const uint32_t n = static_cast<uint32_t>(polygon.size());
  const auto add_ring = [&](std::span<const glm::dvec2> ring, double z) {
    for (const glm::dvec2& p : ring) mesh.positions.emplace_back(glm::vec3(glm::dvec3(p, z)));
  };
  if (bevel > 0) {
    const Polygon small = inset(polygon, bevel);
    add_ring(small, back);
    add_ring(polygon, back + bevel);
    add_ring(polygon, front - bevel);
    add_ring(small, front);
  } else {
    add_ring(polygon, back);
    add_ring(polygon, front);
  }
  const uint32_t rings = static_cast<uint32_t>(mesh.positions.size()) / n;
  for (uint32_t i = 0; i + 1 < rings; ++i) {
    for (uint32_t j = 0; j < n; ++j) {
      const uint32_t a = i * n + j, b = i * n + (j + 1) % n;
      mesh.triangles.emplace_back(a, b, b + n);
      mesh.triangles.emplace_back(a, b + n, a + n);
    }
  }
  const uint32_t top = (rings - 1) * n;
  for (const glm::uvec3& t : triangulate(polygon)) {
    mesh.triangles.emplace_back(t.x, t.z, t.y);
    mesh.triangles.push_back(t + top);
  }
  return mesh;
}

}  // namespace shadewright::builtin
