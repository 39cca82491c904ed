// The matrices between world and clip space; the derivations are one line each because GLM's own flip no axis for
// Vulkan and know no reversed depth.
#include "shadewright/geometry/projection.h"

#include <cmath>

namespace shadewright {

glm::dmat4 look_along(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up) {
  const glm::dvec3 back = -glm::normalize(forward);
  glm::dvec3 right = glm::cross(up, back);
  // Parallel up: `right` would be rounding noise. Any perpendicular axis serves.
  if (!(glm::length(right) > 1e-9 * glm::length(up))) {
    glm::dvec3 unused;
    perpendicular_axes(back, right, unused);
  }
  right = glm::normalize(right);
  const glm::dvec3 true_up = glm::cross(back, right);

  glm::dmat4 view_from_world(1.0);
  for (int column = 0; column < 3; ++column) {
    view_from_world[column][0] = right[column];
    view_from_world[column][1] = true_up[column];
    view_from_world[column][2] = back[column];
  }
  view_from_world[3] = glm::dvec4(-glm::dot(right, eye), -glm::dot(true_up, eye), -glm::dot(back, eye), 1.0);
  return view_from_world;
}

glm::dmat4 perspective_reversed_infinite(double fov_y, double aspect, double near) {
  const double focal = 1.0 / std::tan(0.5 * fov_y);
  glm::dmat4 clip_from_view(0.0);
  clip_from_view[0][0] = focal / aspect;
  clip_from_view[1][1] = -focal;
  clip_from_view[3][2] = near;  // depth = near / -z: 1 at the near plane, 0 at infinity
  clip_from_view[2][3] = -1.0;
  return clip_from_view;
}

glm::dmat4 perspective_window(const glm::dvec2& window_min, const glm::dvec2& window_max, double near, double far) {
  const glm::dvec2 size = window_max - window_min;
  const glm::dvec2 sum = window_max + window_min;
  // ndc = (2 tangent - sum) / size with tangent = x / -z and w = -z, hence clip = (2 x + sum z) / size; y is flipped.
  glm::dmat4 clip_from_view(0.0);
  clip_from_view[0][0] = 2.0 / size.x;
  clip_from_view[2][0] = sum.x / size.x;
  clip_from_view[1][1] = -2.0 / size.y;
  clip_from_view[2][1] = -sum.y / size.y;
  clip_from_view[2][2] = -far / (far - near);
  clip_from_view[3][2] = -far * near / (far - near);
  clip_from_view[2][3] = -1.0;
  return clip_from_view;
}

glm::dmat4 orthographic(const Box& box) {
  const glm::dvec3 size = box.size();
  const glm::dvec3 center = box.center();
  glm::dmat4 clip_from_view(1.0);
  clip_from_view[0][0] = 2.0 / size.x;
  clip_from_view[1][1] = -2.0 / size.y;
  clip_from_view[2][2] = -1.0 / size.z;
  clip_from_view[3] = glm::dvec4(-2.0 * center.x / size.x, 2.0 * center.y / size.y, box.max.z / size.z, 1.0);
  return clip_from_view;
}

void perpendicular_axes(const glm::dvec3& axis, glm::dvec3& u, glm::dvec3& v) {
  // Frisvad, "Building an Orthonormal Basis from a 3D Unit Vector Without Normalization" (2012), with 1 / (1 + z)
  // written as (1 - z) / (x^2 + y^2) on the lower half so that nothing cancels near the pole at -Z.
  const double sideways = axis.x * axis.x + axis.y * axis.y;
  if (axis.z < 0.0 && sideways == 0.0) {
    u = {0, -1, 0};
    v = {-1, 0, 0};
    return;
  }
  const double a = axis.z < 0.0 ? (1.0 - axis.z) / sideways : 1.0 / (1.0 + axis.z);
  const double b = -axis.x * axis.y * a;
  u = {1.0 - axis.x * axis.x * a, b, -axis.x};
  v = {b, 1.0 - axis.y * axis.y * a, -axis.y};
}

}  // namespace shadewright
