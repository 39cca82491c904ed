// A street with driving cars and two aeroplanes low above it (PSM, figure 9), a camera that drives along, and on demand
// a crowd (figure 8). Everything is closed; all motion is rigid.
#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/aeroplane.h"
#include "scene/builtin/figure.h"
#include "scene/builtin/house.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/stage.h"
#include "scene/builtin/street_things.h"
#include "scene/builtin/tree.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double half_length = 75, half_road = 4.6, pavement = 0.15, pavement_width = 4.2, duration = 12;

constexpr std::array<uint32_t, 8> plasters = {0xD9C7A3, 0xC98F6B, 0xE3DCCB, 0xA9B5A0,
                                              0xD8B98C, 0xB7685A, 0xC9B7C0, 0x9FB0BD};
constexpr std::array<uint32_t, 8> paints = {0xB23B32, 0x2F5D8C, 0xE2E0DA, 0x4A5054,
                                            0x6F8F5F, 0xD9A441, 0x8C8F94, 0x7A4B6A};

/// A motion through `points` at even times, nose along the way; `roll` (radians) leans into it at each point.
uint32_t add_motion(Scene& scene, const std::string& name, const std::vector<glm::dvec3>& points,
                    const std::vector<double>& roll) {
  Motion motion;
  motion.name = name;
  const size_t n = points.size();
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec3 way = points[std::min(i + 1, n - 1)] - points[i > 0 ? i - 1 : 0];
    const glm::dvec3 x = glm::normalize(way), z = glm::normalize(glm::cross(x, glm::dvec3(0, 1, 0))),
                     y = glm::cross(z, x);
    const glm::dmat3 axes(x, y, z);
    motion.times.push_back(duration * double(i) / double(n - 1));
    motion.translations.push_back(points[i]);
    motion.rotations.push_back(glm::normalize(glm::quat_cast(axes) * glm::angleAxis(roll[i], glm::dvec3(1, 0, 0))));
  }
  scene.motions.push_back(std::move(motion));
  return static_cast<uint32_t>(scene.motions.size() - 1);
}

void add_ground(Scene& scene) {
  const double edge = half_road + pavement_width + 14;
  place(scene, "asphalt", slab({-edge, -1, -half_length - 8}, {edge, 0, half_length + 8}, 0.02), color(0x66686B));
  for (const double side : {-1.0, 1.0}) {
    const double inner = side * half_road, outer = side * (edge - 0.5);
    place(scene, "pavement",
          slab({std::min(inner, outer), -0.3, -half_length}, {std::max(inner, outer), pavement, half_length}, 0.03),
          color(0xB8B2A6));
  }
  const uint32_t dash = add_mesh(scene, "road marking", slab({-0.08, -0.05, -1.4}, {0.08, 0.015, 1.4}, 0.004));
  for (int k = 0; k < 21; ++k)
    place(scene, "road marking", dash, color(0xE8E6DF), moved({0, 0, -half_length + 3.5 + 7.1 * k}));
}

void add_houses(Scene& scene, Random& random) {
  std::vector<Prop> houses;
  const std::array<double, 6> widths = {8.5, 10, 9, 11.5, 8, 12};
  for (size_t k = 0; k < widths.size(); ++k) {
    HouseShape shape;
    shape.width = widths[k];
    shape.depth = 10;
    shape.floors = 2 + static_cast<int>(k % 3);
    shape.roof = std::array{Roof::gable, Roof::hip, Roof::flat}[k % 3];
    shape.detail = 1;
    houses.push_back(house(scene, shape, random));
  }
  for (const double side : {-1.0, 1.0}) {
    double z = -half_length + 2;
    for (size_t k = side > 0 ? 3 : 0;; ++k) {
      const double width = widths[k % widths.size()];
      if (z + width > half_length) break;
      place(scene, houses[k % widths.size()],
            moved({side * (half_road + pavement_width + 5.2 + random.range(0, 0.5)), pavement, z + 0.5 * width}) *
                turned_y(-side * pi / 2),
            shade(color(plasters[random.index(8)]), random.range(0.92, 1.06)));
      z += width + (k % 4 == 3 ? 4.0 : 0.15);
    }
  }
}

void add_furniture(Scene& scene, Random& random) {
  const Prop lamp = street_lamp(scene, 2), seat = bench(scene, 1), post = bollard(scene, 1), basket = bin(scene, 1);
  std::vector<Prop> trees;
  for (int k = 0; k < 3; ++k) {
    TreeShape shape;
    shape.height = random.range(6, 7.5);
    shape.spread = 2;
    shape.crown = Crown::leaves;
    shape.leaf_count = 330;
    shape.leaf_size = 0.42;
    trees.push_back(broadleaf_tree(scene, shape, random));
  }
  constexpr std::array<uint32_t, 4> greens = {0x6F9A45, 0x5C8A3C, 0x86A84E, 0x9AA64A};
  for (const double side : {-1.0, 1.0}) {
    for (int k = 0; k < 7; ++k) {
      const double z = -half_length + 11 + 21.5 * k;
      place(scene, lamp, moved({side * (half_road + 0.55), pavement, z}) * turned_y(side > 0 ? pi : 0));
      place(scene, trees[random.index(3)],
            moved({side * (half_road + 1.1), pavement, z + 10.5}) * turned_y(random.angle()) *
                scaled(glm::dvec3(random.range(0.85, 1.1))),
            color(greens[random.index(4)]));
      if (k % 2 == 0)
        place(scene, seat, moved({side * (half_road + 1.5), pavement, z + 4}) * turned_y(side > 0 ? -pi / 2 : pi / 2));
      if (k % 3 == 1) place(scene, basket, moved({side * (half_road + 0.7), pavement, z + 2}));
      for (int i = 0; i < 3; ++i) place(scene, post, moved({side * (half_road + 0.35), pavement, z - 4.5 + 1.4 * i}));
    }
  }
}

void add_traffic(Scene& scene, Random& random) {
  std::vector<Prop> cars;
  for (int k = 0; k < 3; ++k) cars.push_back(car(scene, 2, random));
  for (int k = 0; k < 6; ++k) {
    const double side = k % 2 ? 1 : -1;
    place(scene, cars[static_cast<size_t>(k % 3)],
          moved({side * (half_road - 1.05), 0, -52 + 19.0 * k}) * turned_y(side * pi / 2),
          color(paints[random.index(8)]));
  }
  // Right-hand traffic: towards -Z on the side of +X.
  for (int k = 0; k < 4; ++k) {
    const double side = k % 2 ? 1 : -1, from = side * (58 - 17.0 * k), speed = 7.5 + 0.8 * k;
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= 8; ++i)
      points.emplace_back(side * 1.35 + 0.12 * std::sin(1.1 * i + k), 0, from - side * speed * duration * i / 8);
    place(scene, cars[static_cast<size_t>((k + 1) % 3)], glm::dmat4(1.0),
          color(paints[static_cast<size_t>(2 * k + 1) % 8]),
          add_motion(scene, "car " + std::to_string(k + 1), points, std::vector<double>(points.size(), 0.0)));
  }
  const Prop plane = aeroplane(scene);
  for (int k = 0; k < 2; ++k) {
    std::vector<glm::dvec3> points;
    std::vector<double> roll;
    for (int i = 0; i <= 16; ++i) {
      const double t = i / 16.0, s = k ? 1 - t : t;
      points.emplace_back((k ? 3 : -4) + 10 * std::sin(2 * pi * t + k), 21 + 4 * k + 2.5 * std::sin(4.5 * t + k),
                          -66 + 120 * s);
      roll.push_back(0.35 * std::sin(2 * pi * t + 1.2 + k));
    }
    place(scene, plane, glm::dmat4(1.0), color(k ? 0x3F6FA5 : 0xC0392B),
          add_motion(scene, "aeroplane " + std::to_string(k + 1), points, roll));
  }
}

void add_crowd(Scene& scene, Random& random) {
  std::vector<Prop> people;
  for (int k = 0; k < 6; ++k) people.push_back(person(scene, 2 * pi * k / 6, random));
  for (int k = 0; k < 120; ++k) {
    const double side = random.chance(0.5) ? 1 : -1;
    const glm::dvec3 at(side * (half_road + random.range(0.5, pavement_width - 0.5)), pavement,
                        random.range(-0.95, 0.95) * half_length);
    place(scene, people[random.index(6)],
          moved(at) * turned_y((random.chance(0.5) ? pi / 2 : -pi / 2) + random.range(-0.4, 0.4)) *
              scaled(glm::dvec3(random.range(0.9, 1.06))),
          color(paints[random.index(8)]));
  }
}

void add_drive(Scene& scene) {
  std::vector<Waypoint> waypoints;
  constexpr int keys = 7;
  for (int k = 0; k < keys; ++k) {
    const double t = double(k) / (keys - 1);
    const glm::dvec3 eye(1.6 - 2.4 * t * t, 1.7 + 3.0 * t * t, 68 - 78 * t);
    waypoints.push_back({eye, eye + glm::dvec3(1.5 * std::sin(5 * t), 0.6 - 1.2 * t, -14)});
  }
  add_camera_path(scene, "main", duration / (keys - 1), waypoints, 55);
}

}  // namespace

BuiltinScene street() {
  BuiltinScene entry;
  entry.name = "street";
  entry.help = "a street with driving cars and two flying aeroplanes, camera path main (PSM fig. 9; crowd: fig. 8)";
  entry.parameters = {{"crowd", "1 adds 120 people on the pavements", 0, 0, 1}};
  entry.make = [](const BuiltinValues& values) {
    Scene scene;
    scene.name = "street";
    Random random(9);
    add_ground(scene);
    add_houses(scene, random);
    add_furniture(scene, random);
    add_traffic(scene, random);
    if (values.at("crowd") >= 0.5) add_crowd(scene, random);
    add_camera(scene, "main", {1.6, 1.7, 68}, {1.9, 2.6, 54}, 55);
    add_camera(scene, "overview", {30, 30, 64}, {-2, 2, 16}, 50);
    add_camera(scene, "pavement", {6.4, 1.65, 30}, {2.2, 2.4, 10}, 58);
    add_drive(scene);
    add_sun(scene, 160, 44);
    return scene;
  };
  return entry;
}

}  // namespace shadewright::builtin
