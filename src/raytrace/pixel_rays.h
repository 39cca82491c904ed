// A PixelGrid's rays with the camera's axes computed once.
#pragma once

#include <glm/glm.hpp>

#include "shadewright/raytrace/tracer.h"

namespace shadewright {

/// World-space directions of unit view depth: corner + x * step_x + y * step_y at image position (x, y).
struct PixelRays {
  glm::dvec3 eye, forward, corner, step_x, step_y;

  explicit PixelRays(const PixelGrid& grid);
  glm::dvec3 operator()(double x, double y) const { return corner + x * step_x + y * step_y; }
};

}  // namespace shadewright
