// A ball of curly fur on a plinth before a wall (RMSM, figures 1 and 5). Every hair is a closed tube of three sides.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/random.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/sweep.h"
#include "scene/builtin/stage.h"

namespace shadewright::builtin {
namespace {

constexpr int hair_count = 4000, hair_segments = 12;
constexpr double hair_radius = 0.0015;  // metres: of the circle through a hair's three corners
constexpr double ball_radius = 0.23;
constexpr glm::dvec3 ball_center(0, 0.72, 0);

/// Even directions over the sphere: a Fibonacci spiral, jittered.
glm::dvec3 root_direction(int i, Random& random) {
  const double y = 1 - 2 * (i + random.range(0.1, 0.9)) / hair_count;
  const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0)) + random.range(-0.03, 0.03);
  const double r = std::sqrt(std::max(0.0, 1 - y * y));
  return {r * std::cos(angle), y, r * std::sin(angle)};
}

/// A hair's spine: it leaves the skin, bends down under its weight, and curls more towards its end.
Path hair(const glm::dvec3& root, Random& random) {
  const double step = random.range(0.2, 0.31) / hair_segments;
  const double curl_radius = random.range(0.01, 0.03), turns = random.range(1.0, 2.1), phase = random.angle();
  const glm::dvec3 lean(random.range(-0.6, 0.6), random.range(-0.4, 0.5), random.range(-0.6, 0.6));
  glm::dvec3 direction = glm::normalize(root + lean);
  const glm::dvec3 side = glm::normalize(glm::cross(direction, glm::dvec3(0.31, 0.52, -0.79)));
  const glm::dvec3 other = glm::cross(direction, side);
  glm::dvec3 spine = ball_center + (ball_radius - 0.006) * root;
  Path path;
  for (int k = 0; k <= hair_segments; ++k) {
    const double s = double(k) / hair_segments;
    const double angle = phase + 2 * std::numbers::pi * turns * s;
    glm::dvec3 p = spine + curl_radius * s * (std::cos(angle) * side + std::sin(angle) * other);
    if (k > 0) {
      // Hair lies on the skin rather than going through it.
      const glm::dvec3 out = p - ball_center;
      const double distance = glm::length(out), least = ball_radius + 0.004 + 0.02 * s;
      if (distance < least) p = ball_center + out * (least / distance);
    }
    path.push_back(p);
    direction = glm::normalize(direction + glm::dvec3(0, -0.16 * (0.3 + s), 0));
    spine += step * direction;
  }
  return path;
}

}  // namespace

BuiltinScene furball() {
  BuiltinScene entry;
  entry.name = "furball";
  entry.help = "4,000 curly hairs of 12 segments and 1.5 mm radius before a wall (RMSM fig. 1, 5)";
  entry.make = [](const BuiltinValues&) {
    Scene scene;
    scene.name = "furball";
    place(scene, "floor", slab({-2.2, -0.2, -0.8}, {2.2, 0, 2.4}, 0.01), color(0xA79A86));
    place(scene, "wall", slab({-2.2, -0.1, -1.0}, {2.2, 2.0, -0.72}, 0.01), color(0xD8D2C4));
    const Profile plinth = {{0.2, -0.01}, {0.2, 0.05},  {0.17, 0.07},  {0.15, 0.1},
                            {0.15, 0.4},  {0.18, 0.43}, {0.185, 0.47}, {0.17, 0.485}};
    place(scene, "plinth", lathe(plinth, 40), color(0x8C8578));
    place(scene, "skin", transformed(sphere(ball_radius, 40, 24), moved(ball_center)), color(0x6B4630));

    // Hairs of one shade share a mesh.
    const std::array<uint32_t, 6> shades = {0x8A5A34, 0xA56F3F, 0xBF8A52, 0x734628, 0xD0A468, 0x945F3C};
    std::array<Mesh, 6> tufts;
    Random random(4000);
    for (int i = 0; i < hair_count; ++i) {
      const glm::dvec3 root = root_direction(i, random);
      append(tufts[random.index(6)], tube(hair(root, random), hair_radius, 3));
    }
    for (size_t k = 0; k < tufts.size(); ++k) place(scene, "fur", std::move(tufts[k]), color(shades[k]));

    add_camera(scene, "wall", {-1.45, 0.95, 1.0}, {-0.38, 0.5, -0.5}, 42);
    add_camera(scene, "furball", {0.62, 1.0, 0.86}, {0.05, 0.78, 0.08}, 36);
    // From the shadows on the wall around to the hairs themselves.
    add_camera_path(scene, "main", 1.5,
                    {{{-1.45, 0.95, 1.0}, {-0.38, 0.5, -0.5}},
                     {{-0.5, 1.1, 1.5}, {-0.1, 0.7, -0.2}},
                     {{0.62, 1.0, 0.86}, {0.05, 0.78, 0.08}}},
                    40);
    add_sun(scene, 52, 21);
    return scene;
  };
  return entry;
}

}  // namespace shadewright::builtin
