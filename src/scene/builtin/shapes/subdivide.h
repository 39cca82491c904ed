// Smooth surfaces from coarse cages of quadrilaterals (Catmull and Clark 1978).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright::builtin {

/// A closed surface of quadrilaterals, counter-clockwise seen from outside; every edge belongs to two of them.
struct QuadMesh {
  std::vector<glm::dvec3> positions;
  std::vector<std::array<uint32_t, 4>> quads;
};

/// One step: each quadrilateral becomes four. Closed stays closed.
QuadMesh subdivide(const QuadMesh& cage);

/// Each quadrilateral cut along its shorter diagonal.
Mesh to_triangles(const QuadMesh& quads);

}  // namespace shadewright::builtin
