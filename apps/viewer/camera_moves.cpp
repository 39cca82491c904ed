#include "camera_moves.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace shadewright::viewer {

namespace {

constexpr double steepest = glm::radians(89.0);

/// Unit vector towards `azimuth` (0 = +X, 90 = +Z) and `elevation`, radians.
glm::dvec3 direction(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation), std::cos(elevation) * std::sin(azimuth)};
}

/// From the eye to what it looks at, turned.
glm::dvec3 turned_sight(const Camera& camera, double yaw, double pitch) {
  const glm::dvec3 sight = camera.target - camera.eye;
  const double distance = glm::length(sight);
  // Where a camera looks straight up or down, its upper edge tells the azimuth.
  glm::dvec3 ahead(sight.x, 0, sight.z);
  if (glm::length(ahead) < 1e-6 * distance)
    ahead = (sight.y > 0 ? -1.0 : 1.0) * glm::dvec3(camera.up.x, 0, camera.up.z);
  const double azimuth = std::atan2(ahead.z, ahead.x);
  const double elevation = std::asin(std::clamp(sight.y / distance, -1.0, 1.0));
  return distance * direction(azimuth + yaw, std::clamp(elevation + pitch, -steepest, steepest));
}

}  // namespace

Camera turned(const Camera& camera, double yaw, double pitch) {
  Camera result = camera;
  result.target = camera.eye + turned_sight(camera, yaw, pitch);
  result.up = {0, 1, 0};
  return result;
}

Camera circled(const Camera& camera, double yaw, double pitch) {
  Camera result = camera;
  result.eye = camera.target - turned_sight(camera, yaw, pitch);
  result.up = {0, 1, 0};
  return result;
}

Camera moved(const Camera& camera, const glm::dvec3& right_up_forward) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
  const glm::dvec3 step =
      right_up_forward.x * right + right_up_forward.y * glm::dvec3(0, 1, 0) + right_up_forward.z * forward;
  Camera result = camera;
  result.eye += step;
  result.target += step;
  return result;
}

Camera approached(const Camera& camera, double factor) {
  Camera result = camera;
  result.eye = camera.target + factor * (camera.eye - camera.target);
  return result;
}

}  // namespace shadewright::viewer
