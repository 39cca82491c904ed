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

/// The level direction in which a camera looks. Where it looks straight up or down its upper edge tells, if it can.
glm::dvec3 ahead(const Camera& camera) {
  const glm::dvec3 sight = glm::normalize(camera.target - camera.eye), level(sight.x, 0, sight.z);
  if (glm::length(level) > 1e-6) return glm::normalize(level);
  const glm::dvec3 edge = (sight.y > 0 ? -1.0 : 1.0) * glm::dvec3(camera.up.x, 0, camera.up.z);
  return glm::length(edge) > 1e-6 ? glm::normalize(edge) : glm::dvec3(0, 0, -1);
}

/// From the eye to what it looks at, turned.
glm::dvec3 turned_sight(const Camera& camera, double yaw, double pitch) {
  const glm::dvec3 sight = camera.target - camera.eye, level = ahead(camera);
  const double distance = glm::length(sight);
  const double azimuth = std::atan2(level.z, level.x);
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
  const glm::dvec3 right = glm::cross(ahead(camera), glm::dvec3(0, 1, 0));
  const glm::dvec3 step =
      right_up_forward.x * right + right_up_forward.y * glm::dvec3(0, 1, 0) + right_up_forward.z * forward;
  Camera result = camera;
  result.eye += step;
  result.target += step;
  return result;
}

Camera approached(const Camera& camera, double factor, double least, double most) {
  const double distance = glm::distance(camera.eye, camera.target);
  Camera result = camera;
  result.eye = camera.target + std::clamp(factor * distance, least, most) / distance * (camera.eye - camera.target);
  return result;
}

}  // namespace shadewright::viewer
