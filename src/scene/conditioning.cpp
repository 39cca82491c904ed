// Making a scene fit for float arithmetic: content near zero, no triangle without an area.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/conditioning.h"

namespace shadewright {
namespace {

/// How far to move content with these bounds so that it comes near zero: zero unless it is further away than 8 times
/// its size (three bits of a float's 24). The shift is a multiple of a power of two not below the size, on axes where
/// it is at least twice that: then subtracting it from a float inside the box is exact.
glm::dvec3 shift_to_zero(const Box& box) {
  const double size = box.diagonal();
  if (box.empty() || !(glm::length(box.center()) > 8.0 * size)) return glm::dvec3(0.0);
  // A single point is as exact anywhere; its own magnitude's last bit is then the finest grid.
  const double smallest = glm::length(box.center()) * std::numeric_limits<float>::epsilon();
  const double grid = std::exp2(std::ceil(std::log2(std::max(size, smallest))));
  glm::dvec3 shift(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const double center = box.center()[axis];
    if (std::abs(center) >= 2.0 * grid) shift[axis] = std::round(center / grid) * grid;
  }
  return shift;
}

/// Moves each mesh's vertices towards zero; its instances make up for it.
void recentre_meshes(Scene& scene) {
  std::vector<glm::dvec3> shifts;
  for (Mesh& mesh : scene.meshes) {
    shifts.push_back(shift_to_zero(bounds(mesh)));
    if (shifts.back() == glm::dvec3(0.0)) continue;
    for (glm::vec3& p : mesh.positions) p = glm::vec3(glm::dvec3(p) - shifts.back());
  }
  for (Instance& instance : scene.instances) {
    const glm::dvec3& shift = shifts[instance.mesh];
    if (shift == glm::dvec3(0.0)) continue;
    instance.world_from_mesh[3] = instance.world_from_mesh * glm::dvec4(shift, 1.0);
  }
}

bool is_finite(const glm::vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

}  // namespace

bool has_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  if (!is_finite(a) || !is_finite(b) || !is_finite(c)) return false;
  const glm::dvec3 ab = glm::dvec3(b) - glm::dvec3(a), ac = glm::dvec3(c) - glm::dvec3(a);
  const glm::dvec3 largest_each = glm::max(glm::abs(ab), glm::abs(ac));
  const double largest = std::max({largest_each.x, largest_each.y, largest_each.z});
  if (largest == 0.0) return false;
  // Scaling by a power of two rounds nothing.
  const double scale = std::exp2(-std::ilogb(largest));
  return glm::cross(glm::vec3(ab * scale), glm::vec3(ac * scale)) != glm::vec3(0.0f);
}

void drop_unused_vertices(Mesh& mesh) {
  constexpr uint32_t unused = std::numeric_limits<uint32_t>::max();
  std::vector<uint32_t> new_index(mesh.positions.size(), unused);
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) new_index[triangle[corner]] = 0;
  uint32_t count = 0;
  for (size_t i = 0; i < new_index.size(); ++i) {
    if (new_index[i] == unused) continue;
    mesh.positions[count] = mesh.positions[i];
    new_index[i] = count++;
  }
  if (count == mesh.positions.size()) return;
  mesh.positions.resize(count);
  mesh.positions.shrink_to_fit();
  for (glm::uvec3& t : mesh.triangles) t = {new_index[t.x], new_index[t.y], new_index[t.z]};
}

void recentre(Scene& scene) {
  recentre_meshes(scene);
  const glm::dvec3 shift = shift_to_zero(bounds(scene));
  if (shift == glm::dvec3(0.0)) return;

  scene.origin += shift;
  std::vector<bool> motion_is_used(scene.motions.size(), false);
  for (Instance& instance : scene.instances) {
    if (instance.motion)
      motion_is_used[*instance.motion] = true;
    else
      instance.world_from_mesh[3] -= glm::dvec4(shift, 0.0);
  }
  // A moving instance is moved through its motion's translations: moving its rest pose would turn the shift with it.
  for (size_t i = 0; i < scene.motions.size(); ++i) {
    Motion& motion = scene.motions[i];
    if (!motion_is_used[i]) continue;
    if (motion.times.empty()) {
      motion.times = {0.0};
      motion.translations = {glm::dvec3(0.0)};
      motion.rotations = {glm::dquat(1, 0, 0, 0)};
    }
    for (glm::dvec3& translation : motion.translations) translation -= shift;
  }
  const auto move_camera = [&](Camera& camera) {
    camera.eye -= shift;
    camera.target -= shift;
  };
  for (Camera& camera : scene.cameras) move_camera(camera);
  for (Light& light : scene.lights) light.position -= shift;
  for (CameraPath& path : scene.paths)
    for (Camera& key : path.keys) move_camera(key);
}

size_t drop_degenerate_triangles(Scene& scene) {
  constexpr uint32_t dropped_mesh = std::numeric_limits<uint32_t>::max();
  size_t dropped = 0;
  std::vector<Mesh> kept_meshes;
  std::vector<uint32_t> new_index;
  for (Mesh& mesh : scene.meshes) {
    dropped += std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
      const size_t count = mesh.positions.size();
      if (t.x >= count || t.y >= count || t.z >= count || t.x == t.y || t.y == t.z || t.z == t.x) return true;
      return !has_area(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
    });
    drop_unused_vertices(mesh);
    new_index.push_back(mesh.triangles.empty() ? dropped_mesh : static_cast<uint32_t>(kept_meshes.size()));
    if (!mesh.triangles.empty()) kept_meshes.push_back(std::move(mesh));
  }
  scene.meshes = std::move(kept_meshes);
  std::erase_if(scene.instances, [&](const Instance& instance) { return new_index[instance.mesh] == dropped_mesh; });
  for (Instance& instance : scene.instances) instance.mesh = new_index[instance.mesh];
  return dropped;
}

}  // namespace shadewright
