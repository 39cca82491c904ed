#include "scene/builtin/figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/sweep.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;
using namespace figure_size;

size_t index(Bone bone) {
  return static_cast<size_t>(bone);
}

/// A rounded limb hanging down from the origin, `top` and `bottom` its radii.
Mesh limb(double length, double top, double bottom) {
  const double middle = 0.62 * std::max(top, bottom) + 0.38 * std::min(top, bottom);
  return lathe(Profile{{0, -length - 0.9 * bottom},
                       {0.75 * bottom, -length - 0.55 * bottom},
                       {bottom, -length},
                       {middle, -0.45 * length},
                       {top, -0.1 * length},
                       {0.75 * top, 0.5 * top},
                       {0, 0.85 * top}},
               10);
}

Mesh squashed(const Mesh& mesh, double x, double z) {
  return transformed(mesh, scaled({x, 1, z}));
}

}  // namespace

std::array<glm::dmat4, bone_count> walk_pose(double phase) {
  std::array<glm::dmat4, bone_count> pose;
  const auto set = [&](Bone bone, const glm::dmat4& m) { pose[index(bone)] = m; };
  const double sway = 0.05 * std::sin(phase);
  const glm::dmat4 root = turned_y(sway) * turned_x(0.03 * std::sin(phase));
  set(Bone::pelvis, root);
  const glm::dmat4 chest_joint = root * moved({0, pelvis, 0}) * turned_y(-2.2 * sway) * turned_z(-0.06);
  set(Bone::chest, chest_joint);
  set(Bone::head, chest_joint * moved({0, chest + neck, 0}) * turned_y(1.2 * sway) * turned_z(0.05));
  double lowest = 0;
  for (const double side : {-1.0, 1.0}) {
    const bool left = side < 0;
    const double swing = phase + (left ? 0.0 : pi);
    const double hip = 0.08 + 0.46 * std::sin(swing),
                 knee = -(0.12 + 0.85 * std::pow(std::max(0.0, std::cos(swing - 0.35)), 2.0));
    const double heel = -(hip + knee) + 0.25 * std::sin(swing) * std::max(0.0, -std::cos(swing));
    const glm::dmat4 thigh_joint = root * moved({0, 0, side * hip_half}) * turned_z(hip);
    const glm::dmat4 shin_joint = thigh_joint * moved({0, -thigh, 0}) * turned_z(knee);
    const glm::dmat4 foot_joint = shin_joint * moved({0, -shin, 0}) * turned_z(heel);
    set(left ? Bone::thigh_left : Bone::thigh_right, thigh_joint);
    set(left ? Bone::shin_left : Bone::shin_right, shin_joint);
    set(left ? Bone::foot_left : Bone::foot_right, foot_joint);
    for (const glm::dvec4& sole : {glm::dvec4(-0.07, -ankle, 0, 1), glm::dvec4(0.18, -ankle, 0, 1)})
      lowest = std::min(lowest, (foot_joint * sole).y);

    const glm::dmat4 arm_joint = chest_joint * moved({0, chest - 0.04, side * shoulder_half}) * turned_x(-0.1 * side) *
                                 turned_z(-0.5 * std::sin(swing));
    set(left ? Bone::upper_arm_left : Bone::upper_arm_right, arm_joint);
    set(left ? Bone::forearm_left : Bone::forearm_right,
        arm_joint * moved({0, -upper_arm, 0}) * turned_z(0.35 - 0.2 * std::sin(swing)));
  }
  for (glm::dmat4& m : pose) m = moved({0, -lowest, 0}) * m;
  return pose;
}

Prop person(Scene& scene, double phase, Random& random) {
  const auto pose = walk_pose(phase);
  const auto at = [&](Bone bone) { return pose[index(bone)]; };
  Mesh skin, shirt, trousers, shoes, hair;
  const Profile torso = {{0, -0.06},   {0.13, -0.05}, {0.15, 0.1},  {0.155, 0.26},
                         {0.17, 0.36}, {0.11, 0.425}, {0.05, 0.45}, {0, 0.46}};
  append(shirt, squashed(lathe(torso, 14), 0.68, 1.12), at(Bone::chest));
  append(trousers,
         squashed(lathe(Profile{{0, -0.09}, {0.1, -0.07}, {0.15, 0}, {0.145, 0.14}, {0, 0.16}}, 14), 0.75, 1.08),
         at(Bone::pelvis));
  append(skin, squashed(sphere(0.115, 14, 10), 0.95, 0.78),
         at(Bone::head) * moved({0.01, 0.1, 0}) * scaled({1, 1.12, 1}));
  append(skin, cylinder(0.052, 0.16, 10), at(Bone::head) * moved({-0.01, -0.12, 0}));
  append(hair, squashed(sphere(0.122, 14, 8), 0.9, 0.84), at(Bone::head) * moved({-0.022, 0.135, 0}));
  const bool long_sleeves = random.chance(0.6);
  for (const bool left : {true, false}) {
    append(shirt, limb(upper_arm, 0.058, 0.046), at(left ? Bone::upper_arm_left : Bone::upper_arm_right));
    const glm::dmat4 fore = at(left ? Bone::forearm_left : Bone::forearm_right);
    append(long_sleeves ? shirt : skin, limb(forearm, 0.045, 0.034), fore);
    append(skin, squashed(sphere(0.05, 8, 6), 0.9, 0.5), fore * moved({0, -forearm - 0.06, 0}) * scaled({1, 1.6, 1}));
    append(trousers, limb(thigh, 0.088, 0.062), at(left ? Bone::thigh_left : Bone::thigh_right));
    append(trousers, limb(shin, 0.062, 0.048), at(left ? Bone::shin_left : Bone::shin_right));
    const Path sole = {{-0.085, -0.05, 0}, {-0.06, -0.052, 0}, {0.03, -0.054, 0}, {0.12, -0.062, 0}, {0.18, -0.07, 0}};
    const Sizes size = {{0.022, 0.02}, {0.036, 0.038}, {0.042, 0.036}, {0.045, 0.028}, {0.02, 0.02}};
    append(shoes, sweep(regular_polygon(8), sole, size), at(left ? Bone::foot_left : Bone::foot_right));
  }
  Prop prop;
  prop.name = "person";
  const glm::vec3 skins[] = {color(0xE0B090), color(0xC68A5E), color(0x8A5A3C)},
                  hairs[] = {color(0x3A2A20), color(0x8A6034), color(0x1F1A18), color(0xB8B0A8)};
  const glm::vec3 legs[] = {color(0x34425E), color(0x4A4540), color(0x7A6A50)};
  add_part(scene, prop, std::move(skin), skins[random.index(3)]);
  add_part(scene, prop, std::move(shirt), color(0xB0483C), true);
  add_part(scene, prop, std::move(trousers), legs[random.index(3)]);
  add_part(scene, prop, std::move(shoes), color(0x3A2E28));
  add_part(scene, prop, std::move(hair), hairs[random.index(4)]);
  return prop;
}

}  // namespace shadewright::builtin
