// What is drawn, seen and lit: meshes, their instances, motions, cameras, lights. Plain data, with free functions
// around it.
//
// Space: right-handed, +Y up, metres. All positions are relative to `Scene::origin`, which holds how far the content
// was moved towards zero at load, so that float positions stay precise a million metres away (architecture, section 4).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shadewright/geometry/box.h"

namespace shadewright {

/// Triangles that share one local space. Indices in `triangles` are below positions.size(); no triangle is degenerate
/// (repeated index or zero area in float) or has a position that is not finite.
struct Mesh {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
};

/// A rigid motion: keys in ascending time, interpolated linearly (translation) and spherically (rotation), held before
/// the first and after the last key. An empty motion is the identity.
struct Motion {
  std::string name;
  std::vector<double> times;  ///< seconds
  std::vector<glm::dvec3> translations;
  std::vector<glm::dquat> rotations;
};

/// One placing of a mesh. Its transform at time t is motion(t) * world_from_mesh.
struct Instance {
  std::string name;
  uint32_t mesh = 0;
  glm::dmat4 world_from_mesh{1.0};  ///< affine, invertible
  glm::vec3 albedo{0.7f};           ///< linear RGB, 0..1, for the lit image only
  std::optional<uint32_t> motion;   ///< index into Scene::motions; none = static
};

/// A pinhole camera. Its near plane is at `near`, its far plane at infinity.
struct Camera {
  std::string name;
  glm::dvec3 eye{0.0};
  glm::dvec3 target{0, 0, -1};
  glm::dvec3 up{0, 1, 0};
  double fov_y = glm::radians(50.0);  ///< full vertical angle, radians
  double near = 0;                    ///< metres; 0 = chosen from the scene (see `near_distance`)
};

enum class LightKind { directional, spot, point };

/// An infinitely small light: shadows are hard.
struct Light {
  std::string name;
  LightKind kind = LightKind::directional;
  glm::dvec3 position{0.0};                 ///< spot and point
  glm::dvec3 direction{0, -1, 0};           ///< unit, the way the light travels: directional, and the axis of a spot
  double outer_angle = glm::radians(30.0);  ///< spot: half angle of the cone, radians, below pi/2
};

/// A camera that moves: keys in ascending time, Catmull-Rom interpolated, held at both ends.
struct CameraPath {
  std::string name;
  std::vector<double> times;  ///< seconds
  std::vector<Camera> keys;
};

struct Scene {
  std::string name;
  glm::dvec3 origin{0.0};  ///< file coordinates of this scene's zero
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Motion> motions;
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  std::vector<CameraPath> paths;
};

/// world_from_mesh of `instance` at `time` seconds.
glm::dmat4 transform_at(const Scene& scene, const Instance& instance, double time);

/// Bounds of a mesh in its own space; empty for no triangles.
Box bounds(const Mesh& mesh);
/// World bounds of all instances at `time`, from the meshes' boxes.
Box bounds(const Scene& scene, double time = 0);

/// Number of triangles with every instance counted.
size_t triangle_count(const Scene& scene);

/// Directional light towards the sun: azimuth 0 = +X, 90 = +Z; elevation above the horizon. Degrees, as on the command
/// line.
Light sun(double azimuth_degrees, double elevation_degrees);

/// A camera that sees the whole scene, three-quarter from above. For scenes whose backdrop is far larger than their
/// content, the frame follows the 2nd to 98th percentile of triangle positions, weighted by instance.
Camera default_camera(const Scene& scene);

/// The near distance `camera` draws with: its own, or a fraction (1e-4) of the distance scale of what it looks at.
double near_distance(const Scene& scene, const Camera& camera);

/// The scene's camera, light or path of this name; InputError lists the names there are.
const Camera& find_camera(const Scene& scene, std::string_view name);
const Light& find_light(const Scene& scene, std::string_view name);
const CameraPath& find_path(const Scene& scene, std::string_view name);

/// The camera at `time` seconds along `path`.
Camera camera_at(const CameraPath& path, double time);

/// Moves content that is far from zero (compared with its size) towards zero, and each mesh's vertices likewise, so
/// that float positions lose nothing. Scenes near zero stay as they are, bit for bit.
void recentre(Scene& scene);

/// Drops triangles that are degenerate (repeated index, zero area) or not finite, vertices that no triangle uses, and
/// meshes and instances left without any. Returns how many triangles were dropped.
size_t drop_degenerate_triangles(Scene& scene);

}  // namespace shadewright
