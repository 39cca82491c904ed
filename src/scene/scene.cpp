// Measures of a scene, its sun, and finding things by name.
#include "shadewright/scene/scene.h"

#include <cmath>

#include "shadewright/error.h"

namespace shadewright {
namespace {

template <typename Named>
const Named& find_named(const std::vector<Named>& items, std::string_view name, const std::string& kind) {
  std::string names;
  for (const Named& item : items) {
    if (item.name == name) return item;
    names += (names.empty() ? "" : ", ") + item.name;
  }
  const std::string input = kind + " \"" + std::string(name) + "\"";
  if (items.empty()) throw InputError(input, "the scene has no " + kind + " at all", "leave the name out");
  throw InputError(input, "the scene has no " + kind + " of this name", "use one of: " + names);
}

}  // namespace

Box bounds(const Mesh& mesh) {
  Box box;
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) box.extend(glm::dvec3(mesh.positions[triangle[corner]]));
  return box;
}

Box bounds(const Scene& scene, double time) {
  std::vector<Box> mesh_boxes;
  mesh_boxes.reserve(scene.meshes.size());
  for (const Mesh& mesh : scene.meshes) mesh_boxes.push_back(bounds(mesh));
  Box box;
  for (const Instance& instance : scene.instances)
    box.extend(transform(transform_at(scene, instance, time), mesh_boxes[instance.mesh]));
  return box;
}

size_t triangle_count(const Scene& scene) {
  size_t count = 0;
  for (const Instance& instance : scene.instances) count += scene.meshes[instance.mesh].triangles.size();
  return count;
}

namespace {

// Exactly 0 where they are: a wall along the light must not face it by what rounding leaves.
double cosine(double degrees) {
  return std::abs(std::remainder(degrees, 180)) == 90 ? 0 : std::cos(glm::radians(degrees));
}
double sine(double degrees) {
  return std::remainder(degrees, 180) == 0 ? 0 : std::sin(glm::radians(degrees));
}

}  // namespace

Light sun(double azimuth_degrees, double elevation_degrees) {
  const double across = cosine(elevation_degrees);
  const glm::dvec3 towards_sun(across * cosine(azimuth_degrees), sine(elevation_degrees),
                               across * sine(azimuth_degrees));
  Light light;
  light.name = "sun";
  light.direction = -towards_sun;
  return light;
}

const Camera& find_camera(const Scene& scene, std::string_view name) {
  return find_named(scene.cameras, name, "camera");
}

const Light& find_light(const Scene& scene, std::string_view name) {
  return find_named(scene.lights, name, "light");
}

const CameraPath& find_path(const Scene& scene, std::string_view name) {
  return find_named(scene.paths, name, "camera path");
}

}  // namespace shadewright
