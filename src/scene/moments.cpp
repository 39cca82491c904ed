#include "shadewright/scene/moments.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shadewright/error.h"

namespace shadewright {
namespace {

/// How far moment `i` of `count` is from the first to the last, 0..1.
double share(size_t i, size_t count) {
  return count < 2 ? 0.0 : static_cast<double>(i) / static_cast<double>(count - 1);
}

}  // namespace

std::vector<Moment> moments_along(const CameraPath& path, const Light& light, uint32_t count) {
  if (path.keys.empty()) throw InputError("camera path \"" + path.name + "\"", "it has no keys", "choose another one");
  std::vector<Moment> moments(count);
  for (size_t i = 0; i < moments.size(); ++i) {
    const double time = std::lerp(path.times.front(), path.times.back(), share(i, count));
    moments[i] = {time, camera_at(path, time), light};
  }
  return moments;
}

std::vector<Moment> moments_of_motions(const Scene& scene, const Camera& camera, const Light& light, uint32_t count) {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const Motion& motion : scene.motions) {
    if (motion.times.empty()) continue;
    first = std::min(first, motion.times.front());
    last = std::max(last, motion.times.back());
  }
  if (first > last) first = last = 0;
  std::vector<Moment> moments(count, Moment{0, camera, light});
  for (size_t i = 0; i < moments.size(); ++i) moments[i].time = std::lerp(first, last, share(i, count));
  return moments;
}

glm::dvec2 sun_angles(const Light& light) {
  const glm::dvec3 towards = -glm::normalize(light.direction);
  return glm::degrees(glm::dvec2(std::atan2(towards.z, towards.x), std::asin(std::clamp(towards.y, -1.0, 1.0))));
}

void turn_sun(std::span<Moment> moments, const glm::dvec2& from, const glm::dvec2& to) {
  for (size_t i = 0; i < moments.size(); ++i) {
    const glm::dvec2 angles = glm::mix(from, to, share(i, moments.size()));
    moments[i].light.direction = sun(angles.x, angles.y).direction;
  }
}

}  // namespace shadewright
