// Filling a scene: meshes, placed things made of several meshes, cameras and lights by name.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright::builtin {

/// Linear albedo of an sRGB colour 0xRRGGBB, as a colour picker shows it.
glm::vec3 color(uint32_t rgb);
/// `albedo` brightened or darkened, kept within 0.02 .. 0.95.
glm::vec3 shade(const glm::vec3& albedo, double factor);

uint32_t add_mesh(Scene& scene, std::string name, Mesh mesh);
Instance& place(Scene& scene, const std::string& name, uint32_t mesh, const glm::vec3& albedo,
                const glm::dmat4& world_from_mesh = glm::dmat4(1.0));
/// A mesh that is used once.
Instance& place(Scene& scene, const std::string& name, Mesh mesh, const glm::vec3& albedo);

/// A thing of several materials, to be placed often: its meshes are in the scene already.
struct Prop {
  struct Part {
    uint32_t mesh = 0;
    glm::vec3 albedo{0.7f};
    bool dyed = false;  ///< takes the colour given when the prop is placed instead of its own
  };
  std::string name;
  std::vector<Part> parts;
};

/// Adds `mesh` to the scene and to `prop`; an empty mesh is left out.
void add_part(Scene& scene, Prop& prop, Mesh mesh, const glm::vec3& albedo, bool dyed = false);
void place(Scene& scene, const Prop& prop, const glm::dmat4& world_from_prop,
           const std::optional<glm::vec3>& dye = std::nullopt, std::optional<uint32_t> motion = std::nullopt);
size_t triangle_count(const Scene& scene, const Prop& prop);

void add_camera(Scene& scene, std::string name, const glm::dvec3& eye, const glm::dvec3& target,
                double fov_y_degrees = 50);
/// Where a camera path passes, and what it looks at there.
struct Waypoint {
  glm::dvec3 eye, target;
};
/// A camera path of that name: one key every `seconds_between`.
void add_camera_path(Scene& scene, std::string name, double seconds_between, const std::vector<Waypoint>& waypoints,
                     double fov_y_degrees = 50);
/// A directional light named "sun", azimuth and elevation in degrees as on the command line.
void add_sun(Scene& scene, double azimuth_degrees, double elevation_degrees);
void add_spot(Scene& scene, std::string name, const glm::dvec3& position, const glm::dvec3& target,
              double outer_angle_degrees);

}  // namespace shadewright::builtin
