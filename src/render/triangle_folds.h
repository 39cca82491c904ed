// A mesh's folds: by triangle the planes of the triangle and of those beyond its edges, so that who knows where the
// light is finds silhouettes without reading a vertex.
#pragma once

#include <span>
#include <vector>

#include "render/closed_bodies.h"

namespace shadewright::render {

/// By triangle: its plane, then those of the triangles beyond its three edges (corner to next corner).
struct TriangleFolds {
  std::vector<glm::uvec4> normals;  ///< octahedral 2 x snorm16, or shared::no_normal, or shared::open_edge
  std::vector<glm::vec4> offsets;   ///< dot(p, octahedral_direction(normal)) of the planes' points p
};

/// `triangles` and what is `across` their edges (MeshTopology), both as vertices of `positions`, are added. One
/// triangle's plane is the same, to the last bit, in all folds that it is part of.
void append_folds(TriangleFolds& folds, std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                  std::span<const glm::uvec3> across);

}  // namespace shadewright::render
