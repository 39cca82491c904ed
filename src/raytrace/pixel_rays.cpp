#include "raytrace/pixel_rays.h"

#include <cmath>

#include "shadewright/geometry/projection.h"

namespace shadewright {

PixelRays::PixelRays(const PixelGrid& grid) : eye(grid.camera.eye) {
  const Camera& camera = grid.camera;
  const glm::dmat3 world_from_view =
      glm::transpose(glm::dmat3(look_along(camera.eye, camera.target - camera.eye, camera.up)));
  const double tangent_y = std::tan(0.5 * camera.fov_y), tangent_x = tangent_y * grid.width / grid.height;
  forward = -world_from_view[2];
  corner = forward - tangent_x * world_from_view[0] + tangent_y * world_from_view[1];
  step_x = 2 * tangent_x / grid.width * world_from_view[0];
  step_y = -2 * tangent_y / grid.height * world_from_view[1];
}

glm::dvec3 PixelGrid::ray(double x, double y) const {
  return PixelRays(*this)(x, y);
}

}  // namespace shadewright
