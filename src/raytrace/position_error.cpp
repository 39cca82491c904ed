// How far a camera pass's float surface points lie from their triangles' planes.
//
// The pass rasterizes depth = near / w, interpolated as a plane over the screen, and a point is eye + ray * near /
// depth. In units of u = 2^-24 (half an ulp), to first order:
//
// World coordinates, relative to |x| + |y| + |z|: a vertex shader that fuses multiply-adds moves vertices against ours
// by 2, clip_from_world * position cancels the eye's coordinates (2 of the 4 rounded terms), rounding the eye costs 1,
// adding it to the ray 1, and the shadow ray's origin another 1. Bound 8; measured at most 3 without the fused
// multiply-adds.
//
// Distance from the eye: on a plane at distance D from the eye, with normal n, 1/w along the pixel ray r is q = (n . r)
// / D. An error dq moves the point by w^2 dq along r, so by w^2 dq (n . r) = w D dq off the plane. Interpolation adds
// up terms of at most max |q| <= max |r| / D over the screen, however tilted the plane: D cancels, and each rounding
// costs w max |r|, whatever the slope. The division at the vertices (2), the gradients (6), the start and two products
// (5), near / depth (1) and the ray (2) make 16 with max |r| = 1, and 32 for fields of view up to 120 degrees.
// Measured: at most 10, 99% below 3.
//
// The bound does not hold for world positions that are interpolated themselves: their planes over the screen do not
// cancel (measured: 1% above 50 u). Nor for triangles that are clipped far outside the screen (a guard band of several
// screens).
#include "geometry/position_error.h"

#include <cmath>
#include <glm/glm.hpp>

#include "shadewright/raytrace/tracer.h"

namespace shadewright {

float position_error(const glm::vec3& position, const glm::vec3& eye) {
  const float coordinates = std::abs(position.x) + std::abs(position.y) + std::abs(position.z);
  return position_error_of_coordinates * coordinates + position_error_of_distance * glm::distance(position, eye);
}

}  // namespace shadewright
