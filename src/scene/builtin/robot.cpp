#include "scene/builtin/robot.h"

#include <cmath>
#include <numbers>

#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/extrude.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/loft.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/sweep.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;
using namespace figure_size;

/// What a bone is made of: painted armour, steel, and dark joints.
struct Parts {
  Mesh armour, steel, dark;
};

/// A hinge across z, with two rims and six bolts a side.
void add_hinge(Parts& p, double radius, double width) {
  const glm::dmat4 across = turned_x(pi / 2);
  append(p.dark, cylinder(radius, width, 20), across * moved({0, -0.5 * width, 0}));
  for (const double side : {-1.0, 1.0}) {
    append(p.steel, torus(radius * 0.86, radius * 0.2, 16, 7), across * moved({0, side * 0.5 * width, 0}));
    for (int k = 0; k < 6; ++k) {
      const double a = 2 * pi * k / 6;
      append(p.steel, cylinder(radius * 0.11, width * 0.5 + 0.008, 6),
             turned_x(side * pi / 2) * moved({0.5 * radius * std::cos(a), 0.05 * width, 0.5 * radius * std::sin(a)}));
    }
  }
}

/// A plate round a limb that hangs down: rings of a superellipse, `top` and `bottom` (x, z half sizes), from y0 down to
/// y1.
Mesh shell(double y0, double y1, const glm::dvec2& top, const glm::dvec2& bottom) {
  std::vector<Ring> rings;
  constexpr int sides = 20, steps = 6;
  for (int j = 0; j <= steps; ++j) {
    const double t = double(j) / steps, belly = 1 + 0.16 * std::sin(pi * t), edge = j == 0 || j == steps ? 0.86 : 1.0;
    const glm::dvec2 size = glm::mix(bottom, top, t) * belly * edge;
    Ring ring;
    for (int i = 0; i < sides; ++i) {
      const double a = 2 * pi * i / sides, c = std::cos(a), s = std::sin(a);
      const double blunt = std::pow(std::pow(std::abs(c), 4.0) + std::pow(std::abs(s), 4.0), -0.25);
      ring.emplace_back(size.x * c * blunt, y1 + (y0 - y1) * t, -size.y * s * blunt);
    }
    rings.push_back(ring);
  }
  return loft(rings);
}

/// A piston beside a limb: cylinder, rod and two eyes.
void add_piston(Parts& p, const glm::dvec3& a, const glm::dvec3& b, double radius) {
  const glm::dvec3 middle = glm::mix(a, b, 0.58);
  append(p.dark, rod(a, middle, radius, 14));
  append(p.steel, rod(glm::mix(a, b, 0.5), b, 0.55 * radius, 12));
  for (const glm::dvec3& end : {a, b}) append(p.steel, sphere(1.35 * radius, 10, 6), moved(end));
}

Parts limb(double length, const glm::dvec2& top, const glm::dvec2& bottom, double hinge) {
  Parts p;
  add_hinge(p, hinge, 2.5 * hinge);
  append(p.armour, shell(-0.14 * length, -0.84 * length, top, bottom));
  append(p.dark, rod({0, 0, 0}, {0, -length, 0}, 0.5 * hinge, 12));
  add_piston(p, {-1.25 * top.x, -0.1 * length, 0}, {-1.15 * bottom.x, -0.92 * length, 0}, 0.011);
  return p;
}

void add_fingers(Parts& p) {
  append(p.armour, slab({-0.03, -forearm - 0.085, -0.02}, {0.03, -forearm - 0.01, 0.02}, 0.006));
  for (int k = 0; k < 4; ++k) {
    const double x = -0.024 + 0.016 * k, y = -forearm - 0.08;
    append(p.steel, tube(Path{{x, y, 0}, {x + 0.004, y - 0.035, 0.004}, {x + 0.002, y - 0.065, 0.016}}, 0.0065, 7));
  }
  append(p.steel,
         tube(Path{{0.03, -forearm - 0.03, 0}, {0.05, -forearm - 0.06, 0.008}, {0.05, -forearm - 0.085, 0.016}}, 0.0075,
              7));
}

Parts chest_parts() {
  Parts p;
  append(p.armour, shell(0.36, 0.1, {0.125, 0.185}, {0.1, 0.14}));
  append(p.dark, shell(0.16, -0.06, {0.075, 0.1}, {0.08, 0.11}));
  for (int k = 0; k < 5; ++k)
    append(p.steel, torus(0.098, 0.012, 28, 8), moved({0, -0.02 + 0.028 * k, 0}) * scaled({0.85, 1, 1.15}));
  // A lamp in the breast, grilles, and a pack with two bottles.
  append(p.steel, lathe(Profile{{0.045, 0}, {0.05, 0.012}, {0.042, 0.022}, {0.03, 0.018}, {0, 0.024}}, 24),
         along({0.125, 0.25, 0}, {1, 0, 0}));
  for (int k = 0; k < 6; ++k)
    for (const double z : {-0.1, 0.1})
      append(p.dark, slab({0.1, 0, z - 0.03}, {0.137, 0.008, z + 0.03}, 0.002), moved({0, 0.19 + 0.018 * k, 0}));
  append(p.armour, slab({-0.2, 0.1, -0.11}, {-0.09, 0.36, 0.11}, 0.02));
  for (const double z : {-0.06, 0.06})
    append(p.steel,
           lathe(Profile{{0, 0},
                         {0.03, 0.01},
                         {0.042, 0.04},
                         {0.042, 0.2},
                         {0.03, 0.235},
                         {0.012, 0.245},
                         {0.012, 0.26},
                         {0, 0.262}},
                 16),
           moved({-0.225, 0.1, z}));
  for (const double z : {-1.0, 1.0}) {
    append(p.dark, rod({0, chest - 0.04, 0.12 * z}, {0, chest - 0.04, shoulder_half * z}, 0.035, 16));
    append(p.armour, lathe(Profile{{0.088, 0}, {0.09, 0.02}, {0.075, 0.06}, {0.04, 0.085}, {0, 0.092}}, 24),
           moved({0, chest - 0.035, 0.195 * z}));
  }
  append(p.dark, cylinder(0.04, 0.12, 16), moved({0, chest - 0.06, 0}));
  return p;
}

Parts head_parts() {
  Parts p;
  append(p.armour, shell(0.21, 0.0, {0.085, 0.08}, {0.075, 0.065}));
  append(p.dark, slab({0.06, 0.095, -0.068}, {0.1, 0.14, 0.068}, 0.006));
  for (const double z : {-0.035, 0.035}) append(p.steel, sphere(0.018, 14, 10), moved({0.1, 0.118, z}));
  for (const double z : {-1.0, 1.0}) {
    append(p.dark, cylinder(0.035, 0.028, 18), moved({0, 0.11, z * 0.075}) * turned_x(z * pi / 2));
    append(p.steel, rod({-0.01, 0.12, z * 0.1}, {-0.05, 0.31, z * 0.115}, 0.004, 8));
    append(p.steel, sphere(0.009, 8, 6), moved({-0.05, 0.31, z * 0.115}));
  }
  for (int k = 0; k < 5; ++k)
    append(p.dark, slab({0.05, 0.028 + 0.011 * k, -0.035}, {0.0905, 0.034 + 0.011 * k, 0.035}, 0.0015));
  append(p.steel, cylinder(0.045, 0.05, 18), moved({0, -0.045, 0}));
  return p;
}

Parts pelvis_parts() {
  Parts p;
  append(p.armour, shell(0.1, -0.06, {0.095, 0.12}, {0.07, 0.075}));
  append(p.dark, rod({0, 0, -hip_half - 0.03}, {0, 0, hip_half + 0.03}, 0.045, 20));
  append(p.steel, slab({0.07, -0.02, -0.03}, {0.11, 0.07, 0.03}, 0.008));
  return p;
}

Parts foot_parts() {
  Parts p;
  add_hinge(p, 0.038, 0.1);
  const Polygon side = {{-0.08, -ankle}, {0.19, -ankle}, {0.19, -ankle + 0.025}, {0.13, -ankle + 0.05},
                        {0.04, -0.02},   {-0.05, -0.02}, {-0.08, -0.055}};
  append(p.armour, extrude(side, -0.05, 0.05, 0.008));
  append(p.dark, slab({-0.085, -ankle - 0.001, -0.055}, {0.195, -ankle + 0.014, 0.055}, 0.004));
  for (const double z : {-0.03, 0.0, 0.03})
    append(p.steel, rod({0.1, -ankle + 0.06, z}, {0.18, -ankle + 0.03, z}, 0.009, 8));
  return p;
}

}  // namespace

std::array<Prop, bone_count> robot_bones(Scene& scene) {
  std::array<Prop, bone_count> bones;
  const auto set = [&](Bone bone, const char* name, const Parts& p) {
    Prop& prop = bones[static_cast<size_t>(bone)];
    prop.name = name;
    add_part(scene, prop, p.armour, color(0xC9573F), true);
    add_part(scene, prop, p.steel, color(0xB4B8BC));
    add_part(scene, prop, p.dark, color(0x4A4E54));
  };
  set(Bone::pelvis, "robot pelvis", pelvis_parts());
  set(Bone::chest, "robot chest", chest_parts());
  set(Bone::head, "robot head", head_parts());
  const Parts arm = limb(upper_arm, {0.05, 0.05}, {0.042, 0.042}, 0.04);
  Parts fore = limb(forearm, {0.045, 0.045}, {0.036, 0.036}, 0.034);
  add_fingers(fore);
  const Parts thigh_limb = limb(thigh, {0.078, 0.072}, {0.055, 0.052}, 0.05),
              shin_limb = limb(shin, {0.06, 0.056}, {0.045, 0.045}, 0.046);
  const Parts foot = foot_parts();
  for (const bool left : {true, false}) {
    set(left ? Bone::upper_arm_left : Bone::upper_arm_right, "robot arm", arm);
    set(left ? Bone::forearm_left : Bone::forearm_right, "robot forearm", fore);
    set(left ? Bone::thigh_left : Bone::thigh_right, "robot thigh", thigh_limb);
    set(left ? Bone::shin_left : Bone::shin_right, "robot shin", shin_limb);
    set(left ? Bone::foot_left : Bone::foot_right, "robot foot", foot);
  }
  return bones;
}

}  // namespace shadewright::builtin
