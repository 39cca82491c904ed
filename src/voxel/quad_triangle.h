// A triangle with what the recursion over quads asks of it again and again.
#pragma once

#include <glm/glm.hpp>

#include "sampling.h"
#include "snapped.h"

namespace shadewright::voxel {

struct QuadTriangle {
  SnappedTriangle triangle;
  glm::ivec2 low, high;  ///< its box in sub-voxels
  glm::dvec2 slope;      ///< see `gradient`

  explicit QuadTriangle(const SnappedTriangle& t)
      : triangle(t),
        low(glm::min(t.corners[0], glm::min(t.corners[1], t.corners[2]))),
        high(glm::max(t.corners[0], glm::max(t.corners[1], t.corners[2]))),
        slope(gradient(t)) {}
};

}  // namespace shadewright::voxel
