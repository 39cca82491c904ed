// Walking robots or skeletons (RMSM's robot, 61k, and skeletons, 80k): each bone is an instance of its own with a rigid
// motion, so every shadow changes in every frame. Closed throughout.
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "scene/builtin/figure.h"
#include "scene/builtin/robot.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/skeleton.h"
#include "scene/builtin/stage.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double duration = 8;  // seconds
constexpr int keys_per_second = 12;

/// A walk around a circle about the origin.
struct Round {
  double radius = 3;
  double start = 0;       ///< radians along the circle at time 0
  double cadence = 0.85;  ///< double steps a second
  double phase = 0;       ///< of the walk at time 0, radians
};

/// World from figure: the figure's +X along the circle, counter-clockwise seen from above.
glm::dmat4 place_on(const Round& walk, double time) {
  const double angle = walk.start + walk.cadence * double_step * time / walk.radius;
  return turned_y(angle) * moved({walk.radius, 0, 0}) * turned_y(pi / 2);
}

/// One motion per bone for the whole walk; returns the index of the first.
uint32_t add_walk(Scene& scene, const std::string& name, const Round& walk) {
  const uint32_t first = static_cast<uint32_t>(scene.motions.size());
  scene.motions.resize(first + bone_count);
  for (size_t b = 0; b < bone_count; ++b) scene.motions[first + b].name = name + " bone " + std::to_string(b);
  const int keys = static_cast<int>(duration * keys_per_second) + 1;
  for (int k = 0; k < keys; ++k) {
    const double time = double(k) / keys_per_second;
    const auto pose = walk_pose(walk.phase + 2 * pi * walk.cadence * time);
    for (size_t b = 0; b < bone_count; ++b) {
      const glm::dmat4 world_from_bone = place_on(walk, time) * pose[b];
      Motion& motion = scene.motions[first + b];
      glm::dquat rotation = glm::normalize(glm::quat_cast(glm::dmat3(world_from_bone)));
      // Neighbouring keys on the same half of the sphere, so that interpolation takes the short way.
      if (k > 0 && glm::dot(rotation, motion.rotations.back()) < 0) rotation = -rotation;
      motion.times.push_back(time);
      motion.translations.emplace_back(world_from_bone[3]);
      motion.rotations.push_back(rotation);
    }
  }
  return first;
}

void add_stage(Scene& scene) {
  place(scene, "floor", slab({-7, -0.5, -7}, {7, 0, 7}, 0.03), color(0xB9B4A8));
  // Things that stand still: columns to walk around and between.
  const Profile column = {{0.34, -0.02}, {0.34, 0.12}, {0.27, 0.18}, {0.24, 1.5},
                          {0.22, 2.7},   {0.3, 2.84},  {0.32, 3.0},  {0, 3.0}};
  const uint32_t mesh = add_mesh(scene, "column", lathe(column, 32));
  for (int k = 0; k < 5; ++k)
    place(scene, "column", mesh, color(0xD9D2C2), turned_y(2 * pi * k / 5 + 0.75) * moved({4.2, 0, 0}));
  place(scene, "dais", lathe(Profile{{0.9, -0.05}, {0.9, 0.16}, {0.86, 0.2}, {0, 0.2}}, 64), color(0xA89A86));
}

}  // namespace

BuiltinScene characters() {
  BuiltinScene entry;
  entry.name = "characters";
  entry.help = "walking robots (61k triangles) or, with skeletons=1, skeletons (80k), every bone moving (RMSM)";
  entry.parameters = {{"skeletons", "0 = robots, 1 = skeletons", 0, 0, 1}};
  entry.make = [](const BuiltinValues& values) {
    const bool skeletons = values.at("skeletons") >= 0.5;
    Scene scene;
    scene.name = "characters";
    add_stage(scene);
    const std::array<Prop, bone_count> bones = skeletons ? skeleton_bones(scene) : robot_bones(scene);
    constexpr std::array<uint32_t, 6> paints = {0xC9573F, 0x3F7CAC, 0xD9A441, 0x6B8F58, 0x8A6A9A, 0xC9C5BA};
    constexpr std::array<uint32_t, 6> ivories = {0xE3DAC3, 0xD9CFB6, 0xEAE3D0, 0xCFC4A8, 0xE0D5BA, 0xD6CBB0};
    constexpr int count = 3;
    for (int k = 0; k < count; ++k) {
      Round walk;
      walk.radius = 1.7 + 0.6 * k;
      walk.start = 2 * pi / 3 * k - 1.2;
      walk.cadence = 0.8 + 0.03 * k;
      walk.phase = 1.1 * k;
      const std::string name = (skeletons ? "skeleton " : "robot ") + std::to_string(k + 1);
      const uint32_t motion = add_walk(scene, name, walk);
      for (uint32_t b = 0; b < bone_count; ++b)
        place(scene, bones[b], glm::dmat4(1.0), color((skeletons ? ivories : paints)[static_cast<size_t>(k)]),
              motion + b);
    }
    add_camera(scene, "main", {2.4, 1.9, 5.2}, {0, 0.8, 0}, 45);
    add_camera(scene, "near", {0.9, 1.3, 3.7}, {0.1, 0.85, 0.6}, 48);
    add_camera(scene, "above", {-3, 6.5, 4.6}, {0, 0, 0}, 50);
    // Down from above and in among the walkers.
    add_camera_path(scene, "main", 1.5,
                    {{{-3, 6.5, 4.6}, {0, 0, 0}}, {{2.4, 1.9, 5.2}, {0, 0.8, 0}}, {{0.9, 1.3, 3.7}, {0.1, 0.85, 0.6}}},
                    48);
    add_sun(scene, 150, 38);
    return scene;
  };
  return entry;
}

}  // namespace shadewright::builtin
