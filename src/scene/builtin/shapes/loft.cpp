#include "scene/builtin/shapes/loft.h"

namespace shadewright::builtin {
namespace {

/// Index of point j of a ring that starts at `first`, wrapping round; a pole has one point only.
struct RingIndex {
  uint32_t first = 0, count = 0;
  uint32_t operator[](uint32_t j) const { return count == 1 ? first : first + (j == count ? 0 : j); }
};

void add_band(Mesh& mesh, const RingIndex& low, const RingIndex& high) {
  const uint32_t count = low.count > high.count ? low.count : high.count;
  for (uint32_t j = 0; j < count; ++j) {
    if (low.count > 1) mesh.triangles.emplace_back(low[j], low[j + 1], high[j + 1]);
    if (high.count > 1) mesh.triangles.emplace_back(low[j], high[j + 1], high[j]);
  }
}

void add_cap(Mesh& mesh, const RingIndex& ring, bool faces_forward) {
  if (ring.count < 3) return;
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    if (faces_forward)
      mesh.triangles.emplace_back(a, b, c);
    else
      mesh.triangles.emplace_back(a, c, b);
  };
  if (ring.count <= 4) {
    for (uint32_t j = 1; j + 1 < ring.count; ++j) add(ring[0], ring[j], ring[j + 1]);
    return;
  }
  // A fan about the centroid, not about a corner: rings may have points in a straight row.
  glm::dvec3 center(0.0);
  for (uint32_t j = 0; j < ring.count; ++j) center += glm::dvec3(mesh.positions[ring[j]]);
  const uint32_t middle = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.emplace_back(glm::vec3(center / double(ring.count)));
  for (uint32_t j = 0; j < ring.count; ++j) add(middle, ring[j], ring[j + 1]);
}

}  // namespace

Mesh loft(std::span<const Ring> rings, Ends ends) {
  Mesh mesh;
  std::vector<RingIndex> index;
  for (const Ring& ring : rings) {
    index.push_back({static_cast<uint32_t>(mesh.positions.size()), static_cast<uint32_t>(ring.size())});
    for (const glm::dvec3& p : ring) mesh.positions.emplace_back(glm::vec3(p));
  }
  for (size_t i = 0; i + 1 < index.size(); ++i) add_band(mesh, index[i], index[i + 1]);
  if (ends == Ends::joined) add_band(mesh, index.back(), index.front());
  if (ends == Ends::capped) {
    add_cap(mesh, index.front(), false);
    add_cap(mesh, index.back(), true);
  }
  return mesh;
}

}  // namespace shadewright::builtin
