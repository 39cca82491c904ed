// Which triangles of a mesh bound closed bodies, and what lies across their edges.
#pragma once

#include <cstdint>
#include <vector>

#include "render/shared.h"
#include "shadewright/scene/scene.h"

namespace shadewright::render {

using shared::no_vertex;

struct MeshTopology {
  /// By triangle: 1 where it belongs to a connected component that is closed and oriented outwards, so that whoever is
  /// not inside sees only its counterclockwise sides.
  std::vector<uint8_t> closed;
  /// By triangle and edge (corner to next corner): the third vertex of the triangle across, or no_vertex where there is
  /// not exactly one. Vertices at the same place count as one.
  std::vector<glm::uvec3> across;
};

MeshTopology mesh_topology(const Mesh& mesh);

}  // namespace shadewright::render
