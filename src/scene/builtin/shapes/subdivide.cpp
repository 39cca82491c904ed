#include "scene/builtin/shapes/subdivide.h"

#include <algorithm>
#include <unordered_map>

namespace shadewright::builtin {

QuadMesh subdivide(const QuadMesh& cage) {
  const size_t vertices = cage.positions.size();
  QuadMesh result;
  result.positions = cage.positions;

  // Face points.
  const uint32_t first_face = static_cast<uint32_t>(vertices);
  for (const auto& q : cage.quads)
    result.positions.push_back(
        0.25 * (cage.positions[q[0]] + cage.positions[q[1]] + cage.positions[q[2]] + cage.positions[q[3]]));

  // Edge points: the mean of both ends and both faces' points, filled in as the faces go by.
  std::unordered_map<uint64_t, uint32_t> edge_index;
  std::vector<uint32_t> valence(vertices, 0);
  std::vector<glm::dvec3> face_sum(vertices, glm::dvec3(0)), edge_sum(vertices, glm::dvec3(0));
  const auto edge_point = [&](uint32_t a, uint32_t b, uint32_t face_point) {
    const uint64_t key = (uint64_t{std::min(a, b)} << 32) | std::max(a, b);
    const auto [slot, is_new] = edge_index.emplace(key, static_cast<uint32_t>(result.positions.size()));
    if (is_new) {
      const glm::dvec3 ends = cage.positions[a] + cage.positions[b];
      result.positions.push_back(0.25 * ends);
      for (const uint32_t v : {a, b}) {
        edge_sum[v] += 0.5 * ends;
        ++valence[v];
      }
    }
    result.positions[slot->second] += 0.25 * result.positions[face_point];
    return slot->second;
  };
  for (size_t f = 0; f < cage.quads.size(); ++f) {
    const auto& q = cage.quads[f];
    const uint32_t face_point = first_face + static_cast<uint32_t>(f);
    std::array<uint32_t, 4> edge{};
    for (size_t k = 0; k < 4; ++k) {
      edge[k] = edge_point(q[k], q[(k + 1) % 4], face_point);
      face_sum[q[k]] += result.positions[face_point];
    }
    for (size_t k = 0; k < 4; ++k) result.quads.push_back({q[k], edge[k], face_point, edge[(k + 3) % 4]});
  }

  // Old vertices of valence n: (F + 2 R + (n - 3) P) / n.
  for (size_t v = 0; v < vertices; ++v) {
    const double n = valence[v];
    if (n == 0) continue;
    result.positions[v] = (face_sum[v] / n + 2.0 * edge_sum[v] / n + (n - 3) * cage.positions[v]) / n;
  }
  return result;
}

Mesh to_triangles(const QuadMesh& quads) {
  Mesh mesh;
  for (const glm::dvec3& p : quads.positions) mesh.positions.emplace_back(glm::vec3(p));
  for (const auto& q : quads.quads) {
    const glm::dvec3 d02 = quads.positions[q[2]] - quads.positions[q[0]],
                     d13 = quads.positions[q[3]] - quads.positions[q[1]];
    if (glm::dot(d02, d02) <= glm::dot(d13, d13)) {
      mesh.triangles.emplace_back(q[0], q[1], q[2]);
      mesh.triangles.emplace_back(q[0], q[2], q[3]);
    } else {
      mesh.triangles.emplace_back(q[1], q[2], q[3]);
      mesh.triangles.emplace_back(q[1], q[3], q[0]);
    }
  }
  return mesh;
}

}  // namespace shadewright::builtin
