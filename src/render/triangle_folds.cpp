#include "render/triangle_folds.h"

#include <glm/gtc/packing.hpp>

#include "geometry/place_order.h"
#include "render/octahedral.h"

namespace shadewright::render {

namespace {

struct PackedPlane {
  uint32_t normal;
  float offset;
};

PackedPlane plane_through(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  // Neighbours name the corners in another order: arithmetic begins at the same one.
  if (comes_before(b, a) && !comes_before(c, b)) return plane_through(b, c, a);
  if (comes_before(c, a) && comes_before(c, b)) return plane_through(c, a, b);
  const glm::dvec3 normal = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
  if (normal == glm::dvec3(0)) return {shared::no_normal, 0};
  const uint32_t packed = octahedral_packed(normal);
  return {packed, glm::dot(a, octahedral_direction(glm::unpackSnorm2x16(packed)))};
}

}  // namespace

void append_folds(TriangleFolds& folds, std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                  std::span<const glm::uvec3> across) {
  for (size_t t = 0; t < triangles.size(); ++t) {
    const glm::uvec3& corners = triangles[t];
    glm::uvec4 normals;
    glm::vec4 offsets;
    for (int i = 0; i < 4; ++i) {
      PackedPlane plane{shared::open_edge, 0};
      if (i == 0)
        plane = plane_through(positions[corners.x], positions[corners.y], positions[corners.z]);
      else if (const uint32_t beyond = across[t][i - 1]; beyond != no_vertex)
        plane = plane_through(positions[corners[i % 3]], positions[corners[i - 1]], positions[beyond]);
      normals[i] = plane.normal;
      offsets[i] = plane.offset;
    }
    folds.normals.push_back(normals);
    folds.offsets.push_back(offsets);
  }
}

}  // namespace shadewright::render
