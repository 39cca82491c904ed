// The static triangles of a scene in world space, with their vertices welded by position.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright::voxel {

struct Casters {
  std::vector<glm::dvec3> positions;  ///< world
  std::vector<glm::uvec3> triangles;  ///< indices of `positions`; equal positions have equal indices
  uint64_t moving_instances = 0;      ///< left out: a bake holds what never moves
};

/// Every instance without a motion. Importers split vertices along seams and materials; welding joins them again, so
/// that a closed body is seen to be closed (formulas.md).
Casters gather_casters(const Scene& scene);

}  // namespace shadewright::voxel
