// What the tests here ask of a mesh: is it sound, is it closed?
#pragma once

#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <unordered_map>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright::builtin {

/// Triangles with a repeated index, an area of zero in float, or a position that is not finite.
inline size_t count_unsound_triangles(const Mesh& mesh) {
  size_t count = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const glm::vec3 normal = glm::cross(b - a, c - a);
    const bool has_area = glm::dot(normal, normal) > 0;  // false for NaN too
    const glm::vec3 sum = a + b + c;
    if (t.x == t.y || t.y == t.z || t.z == t.x || !has_area || !std::isfinite(sum.x + sum.y + sum.z)) ++count;
  }
  return count;
}

/// Six times the volume that the mesh encloses, counted with its orientation.
inline double signed_volume(const Mesh& mesh) {
  double volume = 0;
  for (const glm::uvec3& t : mesh.triangles)
    volume += glm::dot(glm::dvec3(mesh.positions[t.x]),
                       glm::cross(glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])));
  return volume;
}

/// Edges that are not shared by exactly two triangles of opposite direction, after welding equal positions.
inline size_t count_open_edges(const Mesh& mesh) {
  struct Hash {
    size_t operator()(const glm::uvec3& bits) const {
      return (size_t{bits.x} * 0x9E3779B97F4A7C15ull) ^ (size_t{bits.y} * 0xC2B2AE3D27D4EB4Full) ^
             (size_t{bits.z} * 0x165667B19E3779F9ull);
    }
  };
  std::unordered_map<glm::uvec3, uint32_t, Hash> welded;
  std::vector<uint32_t> index;
  for (const glm::vec3& p : mesh.positions) {
    const glm::vec3 without_negative_zero = p + 0.0f;
    glm::uvec3 bits;
    std::memcpy(&bits, &without_negative_zero, sizeof bits);
    index.push_back(welded.emplace(bits, static_cast<uint32_t>(welded.size())).first->second);
  }
  std::unordered_map<uint64_t, uint32_t> edges;
  for (const glm::uvec3& t : mesh.triangles) {
    const uint32_t corner[3] = {index[t.x], index[t.y], index[t.z]};
    for (int k = 0; k < 3; ++k) ++edges[(uint64_t{corner[k]} << 32) | corner[(k + 1) % 3]];
  }
  size_t open = 0;
  for (const auto& [edge, count] : edges) {
    const auto opposite = edges.find((edge << 32) | (edge >> 32));
    if (count != 1 || opposite == edges.end() || opposite->second != 1) ++open;
  }
  return open;
}

}  // namespace shadewright::builtin
