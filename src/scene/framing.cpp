// A camera for scenes that bring none, and how near a camera sees.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "shadewright/geometry/projection.h"
#include "shadewright/scene/scene.h"

namespace shadewright {
namespace {

/// The box between two percentiles of triangle centres on each axis. At most some 65,000 triangles are looked at,
/// evenly strided through all instances, so that scenes of millions of instanced triangles cost no more than others.
Box percentile_box(const Scene& scene, double low, double high) {
  constexpr size_t most_samples = 65536;
  const size_t stride = triangle_count(scene) / most_samples + 1;
  std::array<std::vector<double>, 3> coordinates;
  size_t next = 0;  // index of the next triangle to sample, counted from the current instance's first
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::dmat4 world_from_mesh = transform_at(scene, instance, 0.0);
    for (; next < mesh.triangles.size(); next += stride) {
      const glm::uvec3& triangle = mesh.triangles[next];
      const glm::dvec3 sum = glm::dvec3(mesh.positions[triangle.x]) + glm::dvec3(mesh.positions[triangle.y]) +
                             glm::dvec3(mesh.positions[triangle.z]);
      const glm::dvec4 center = world_from_mesh * glm::dvec4(sum / 3.0, 1.0);
      for (int axis = 0; axis < 3; ++axis) coordinates[static_cast<size_t>(axis)].push_back(center[axis]);
    }
    next -= mesh.triangles.size();
  }
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double>& values = coordinates[static_cast<size_t>(axis)];
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto last = static_cast<double>(values.size() - 1);
    box.min[axis] = values[static_cast<size_t>(low * last)];
    box.max[axis] = values[static_cast<size_t>(std::ceil(high * last))];
  }
  return box;
}

/// The box that a person would call the scene: all of it, unless its bulk is far smaller than its extent.
Box content_box(const Scene& scene) {
  const Box all = bounds(scene);
  const Box bulk = percentile_box(scene, 0.02, 0.98);
  return all.diagonal() > 2.0 * bulk.diagonal() && bulk.diagonal() > 0.0 ? bulk : all;
}

}  // namespace

Camera default_camera(const Scene& scene) {
  Camera camera;
  camera.name = "default";
  const Box box = content_box(scene);
  if (box.empty()) return camera;

  const glm::dvec3 towards_eye = glm::normalize(glm::dvec3(0.8, 0.6, 1.0));
  const glm::dmat4 view_from_world = look_along(box.center(), -towards_eye, camera.up);
  // A corner at (x, y, z) of the view from the centre fits when |y| <= tan_y (distance - z), and x likewise. Images
  // wider than 4:3 only see more.
  const double tan_y = std::tan(0.5 * camera.fov_y), tan_x = tan_y * 4.0 / 3.0;
  double distance = 0.0;
  for (const glm::dvec3& corner : box.corners()) {
    const glm::dvec3 p(view_from_world * glm::dvec4(corner, 1.0));
    distance = std::max({distance, p.z + std::abs(p.y) / tan_y, p.z + std::abs(p.x) / tan_x});
  }
  camera.target = box.center();
  camera.eye = box.center() + 1.02 * distance * towards_eye;
  return camera;
}

double near_distance(const Scene& scene, const Camera& camera) {
  if (camera.near > 0) return camera.near;
  // A target far beyond the scene only says a direction: the scene's own size bounds the scale.
  const double size = bounds(scene).diagonal();
  const double focus = glm::distance(camera.eye, camera.target);
  const double scale = size > 0 ? std::min(size, focus) : focus;
  return 1e-4 * scale;
}

}  // namespace shadewright
