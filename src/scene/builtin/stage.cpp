#include "scene/builtin/stage.h"

#include <cmath>
#include <utility>

namespace shadewright::builtin {

glm::vec3 color(uint32_t rgb) {
  const auto linear = [](uint32_t byte) {
    const double s = (byte & 255u) / 255.0;
    return static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  };
  return {linear(rgb >> 16), linear(rgb >> 8), linear(rgb)};
}

glm::vec3 shade(const glm::vec3& albedo, double factor) {
  return glm::clamp(albedo * static_cast<float>(factor), 0.02f, 0.95f);
}

uint32_t add_mesh(Scene& scene, std::string name, Mesh mesh) {
  mesh.name = std::move(name);
  scene.meshes.push_back(std::move(mesh));
  return static_cast<uint32_t>(scene.meshes.size() - 1);
}

Instance& place(Scene& scene, const std::string& name, uint32_t mesh, const glm::vec3& albedo,
                const glm::dmat4& world_from_mesh) {
  Instance& instance = scene.instances.emplace_back();
  instance.name = name;
  instance.mesh = mesh;
  instance.world_from_mesh = world_from_mesh;
  instance.albedo = albedo;
  return instance;
}

Instance& place(Scene& scene, const std::string& name, Mesh mesh, const glm::vec3& albedo) {
  const uint32_t index = add_mesh(scene, name, std::move(mesh));
  return place(scene, name, index, albedo);
}

void add_part(Scene& scene, Prop& prop, Mesh mesh, const glm::vec3& albedo, bool dyed) {
  if (mesh.triangles.empty()) return;
  const uint32_t index = add_mesh(scene, prop.name, std::move(mesh));
  prop.parts.push_back({index, albedo, dyed});
}

void place(Scene& scene, const Prop& prop, const glm::dmat4& world_from_prop, const std::optional<glm::vec3>& dye,
           std::optional<uint32_t> motion) {
  for (const Prop::Part& part : prop.parts) {
    const glm::vec3 albedo = part.dyed && dye ? *dye : part.albedo;
    place(scene, prop.name, part.mesh, albedo, world_from_prop).motion = motion;
  }
}

size_t triangle_count(const Scene& scene, const Prop& prop) {
  size_t count = 0;
  for (const Prop::Part& part : prop.parts) count += scene.meshes[part.mesh].triangles.size();
  return count;
}

namespace {

Camera make_camera(const std::string& name, const glm::dvec3& eye, const glm::dvec3& target, double fov_y_degrees) {
  Camera camera;
  camera.name = name;
  camera.eye = eye;
  camera.target = target;
  camera.fov_y = glm::radians(fov_y_degrees);
  return camera;
}

}  // namespace

void add_camera(Scene& scene, std::string name, const glm::dvec3& eye, const glm::dvec3& target, double fov_y_degrees) {
  scene.cameras.push_back(make_camera(name, eye, target, fov_y_degrees));
}

void add_camera_path(Scene& scene, std::string name, double seconds_between, const std::vector<Waypoint>& waypoints,
                     double fov_y_degrees) {
  CameraPath path;
  for (const Waypoint& at : waypoints) {
    path.times.push_back(seconds_between * static_cast<double>(path.times.size()));
    path.keys.push_back(make_camera(name, at.eye, at.target, fov_y_degrees));
  }
  path.name = std::move(name);
  scene.paths.push_back(std::move(path));
}

void add_sun(Scene& scene, double azimuth_degrees, double elevation_degrees) {
  Light light = sun(azimuth_degrees, elevation_degrees);
  light.name = "sun";
  scene.lights.push_back(std::move(light));
}

void add_spot(Scene& scene, std::string name, const glm::dvec3& position, const glm::dvec3& target,
              double outer_angle_degrees) {
  Light light;
  light.name = std::move(name);
  light.kind = LightKind::spot;
  light.position = position;
  light.direction = glm::normalize(target - position);
  light.outer_angle = glm::radians(outer_angle_degrees);
  scene.lights.push_back(std::move(light));
}

}  // namespace shadewright::builtin
