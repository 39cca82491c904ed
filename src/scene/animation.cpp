// Where moving things are at a time: instances along rigid motions, cameras along paths.
#include <algorithm>

#include "shadewright/scene/scene.h"

namespace shadewright {
namespace {

/// The keys around a time: `share` of the way from key `before` to key `after`, both the same outside of the keys'
/// range.
struct KeySpan {
  size_t before = 0, after = 0;
  double share = 0;
};

/// `times` must not be empty.
KeySpan find_keys(const std::vector<double>& times, double time) {
  const auto upper = std::upper_bound(times.begin(), times.end(), time);
  if (upper == times.begin()) return {};
  const auto after = static_cast<size_t>(upper - times.begin());
  if (after == times.size()) return {after - 1, after - 1, 0.0};
  return {after - 1, after, (time - times[after - 1]) / (times[after] - times[after - 1])};
}

glm::dmat4 pose_at(const Motion& motion, double time) {
  if (motion.times.empty()) return glm::dmat4(1.0);
  const KeySpan span = find_keys(motion.times, time);
  const glm::dquat rotation = glm::slerp(motion.rotations[span.before], motion.rotations[span.after], span.share);
  glm::dmat4 pose = glm::mat4_cast(rotation);
  pose[3] = glm::dvec4(glm::mix(motion.translations[span.before], motion.translations[span.after], span.share), 1.0);
  return pose;
}

/// Slope of the camera path's `value` at a key: the secant of its neighbours (Catmull-Rom), one-sided at the ends.
template <typename Get>
auto slope_at(const CameraPath& path, size_t key, const Get& value) {
  const size_t a = key == 0 ? 0 : key - 1;
  const size_t b = std::min(key + 1, path.keys.size() - 1);
  return (value(path.keys[b]) - value(path.keys[a])) / (path.times[b] - path.times[a]);
}

/// Cubic Hermite between the two keys of `span`, which must differ.
template <typename Get>
auto interpolate(const CameraPath& path, const KeySpan& span, const Get& value) {
  const double s = span.share, s2 = s * s, s3 = s2 * s;
  const double seconds = path.times[span.after] - path.times[span.before];
  return value(path.keys[span.before]) * (2 * s3 - 3 * s2 + 1) + value(path.keys[span.after]) * (3 * s2 - 2 * s3) +
         slope_at(path, span.before, value) * ((s3 - 2 * s2 + s) * seconds) +
         slope_at(path, span.after, value) * ((s3 - s2) * seconds);
}

}  // namespace

glm::dmat4 transform_at(const Scene& scene, const Instance& instance, double time) {
  if (!instance.motion) return instance.world_from_mesh;
  return pose_at(scene.motions[*instance.motion], time) * instance.world_from_mesh;
}

Camera camera_at(const CameraPath& path, double time) {
  if (path.keys.empty()) return {};
  const KeySpan span = find_keys(path.times, time);
  Camera camera = path.keys[span.before];
  if (span.before == span.after || span.share == 0.0) return camera;

  const Camera& next = path.keys[span.after];
  camera.eye = interpolate(path, span, [](const Camera& key) { return key.eye; });
  camera.target = interpolate(path, span, [](const Camera& key) { return key.target; });
  // Up and field of view must not overshoot (a field of view past pi is no camera): straight between the keys.
  camera.up = glm::normalize(glm::mix(camera.up, next.up, span.share));
  camera.fov_y = glm::mix(camera.fov_y, next.fov_y, span.share);
  const bool near_is_given = camera.near > 0 && next.near > 0;
  camera.near = near_is_given ? glm::mix(camera.near, next.near, span.share) : 0.0;
  return camera;
}

}  // namespace shadewright
