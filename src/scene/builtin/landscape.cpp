// Mountains of fractal noise closed into a solid, with boulders strewn over them (CPVS's FractalLandscape). All closed.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/builtin/noise.h"
#include "scene/builtin/random.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/terrain.h"
#include "scene/builtin/stage.h"

namespace shadewright::builtin {
namespace {

constexpr double half_size = 800;  // metres
constexpr uint32_t boulder_segments = 26, boulder_rings = 14;

/// Ridges over broad swells, rougher where it is high, as weather leaves it.
double mountain_height(double x, double z, int octaves) {
  const double u = x / 640 + 3.1, v = z / 640 + 7.7;
  const double swell = 0.5 + 0.5 * noise(0.6 * u, 0.6 * v, 5);
  const double ridges = ridged_noise(u, v, octaves, 0.47, 11);
  return 420 * ridges * (0.35 + 0.65 * swell) - 120;
}

/// A ball broken by two scales of noise: no two directions alike, still closed.
Mesh boulder(uint32_t seed) {
  Mesh mesh = sphere(1.0, boulder_segments, boulder_rings);
  for (glm::vec3& p : mesh.positions) {
    const glm::dvec3 q(p);
    const double bumps =
        0.42 * noise(1.3 * q.x + 5, 1.3 * q.y, 1.3 * q.z, seed) + 0.13 * noise(4 * q.x, 4 * q.y + 9, 4 * q.z, seed + 1);
    p = glm::vec3(q * (1 + bumps) * glm::dvec3(1, 0.78, 0.9));
  }
  return mesh;
}

Scene make_landscape(double triangles) {
  Scene scene;
  scene.name = "landscape";
  const double boulder_triangles = 2.0 * boulder_segments * (boulder_rings - 1);
  const int boulders = std::max(12, static_cast<int>(0.03 * triangles / boulder_triangles));
  // 2 n n + 12 n triangles of terrain and skirt.
  const double terrain = triangles - boulders * boulder_triangles;
  const uint32_t cells = static_cast<uint32_t>(std::sqrt(9.0 + terrain / 2) - 3);
  // Octaves down to a wavelength of about three cells.
  const double wavelength = 640 / (3 * 2 * half_size / cells);
  const int octaves = std::clamp(static_cast<int>(std::log2(std::max(2.0, wavelength))) + 1, 3, 12);
  const auto height = [&](double x, double z) { return mountain_height(x, z, octaves); };
  place(scene, "mountains", terrain_solid({-half_size, -half_size}, {half_size, half_size}, cells, cells, -200, height),
        color(0x9A9680));

  Random random(21);
  std::vector<uint32_t> kinds;
  for (uint32_t k = 0; k < 7; ++k) kinds.push_back(add_mesh(scene, "boulder", boulder(31 * k + 3)));
  const glm::dvec3 camp(-225, 0, 105);
  for (int k = 0; k < boulders; ++k) {
    // Every third lies near the ground camera, so that some are seen from close.
    const bool is_near = k % 3 == 0;
    const double reach = is_near ? 75 * std::sqrt(random.unit()) : 0, angle = random.angle();
    const double x = is_near ? camp.x + 42 + reach * std::cos(angle) : random.range(-0.96, 0.96) * half_size;
    const double z = is_near ? camp.z - 30 + reach * std::sin(angle) : random.range(-0.96, 0.96) * half_size;
    const double size = 0.5 + (is_near ? 3.6 : 5.0) * random.unit() * random.unit();
    place(scene, "boulder", kinds[random.index(7)], shade(color(0xB0A898), random.range(0.85, 1.15)),
          moved({x, height(x, z) + 0.1 * size, z}) * turned_y(random.angle()) * turned_z(random.range(-0.5, 0.5)) *
              scaled(glm::dvec3(size)));
  }
  const auto standing = [&](double x, double z, double above) { return glm::dvec3(x, height(x, z) + above, z); };
  add_camera(scene, "ground", standing(camp.x, camp.z, 1.9), standing(camp.x + 70, camp.z - 50, 12), 55);
  add_camera(scene, "overview", {820, 520, 900}, {60, -60, 60}, 42);
  std::vector<Waypoint> flight;
  for (int k = 0; k < 7; ++k) {
    const double x = camp.x + 90 * k, z = camp.z - 65 * k - 40 * std::sin(1.1 * k);
    flight.push_back({standing(x, z, 8 + 24.0 * k), standing(x + 90, z - 65, 0)});
  }
  add_camera_path(scene, "main", 2, flight, 55);
  add_sun(scene, 200, 45);
  return scene;
}

}  // namespace

BuiltinScene landscape() {
  BuiltinScene entry;
  entry.name = "landscape";
  entry.help = "fractal mountains closed into a solid, with boulders (CPVS FractalLandscape, 2.1M)";
  entry.parameters = {{"triangles", "how many triangles the mountains and boulders have", 2100000, 20000, 10000000}};
  entry.make = [](const BuiltinValues& values) { return make_landscape(values.at("triangles")); };
  return entry;
}

}  // namespace shadewright::builtin
