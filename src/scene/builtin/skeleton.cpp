#include "scene/builtin/skeleton.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"

#include "scene/builtin/shapes/sweep.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;
using namespace figure_size;

/// A long bone from a to b: a thin shaft between two thicker, knobbed ends.
void add_long_bone(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, double radius) {
  constexpr int steps = 10;
  Path path;
  Sizes sizes;
  for (int i = 0; i <= steps; ++i) {
    const double t = double(i) / steps, end = std::abs(2 * t - 1);
    path.push_back(glm::mix(a, b, t) + glm::dvec3(0.25 * radius * std::sin(pi * t), 0, 0));
    const double size = radius * (0.62 + 0.55 * std::pow(end, 5.0)) * (i == 0 || i == steps ? 0.6 : 1.0);
    sizes.emplace_back(size, size * (1 + 0.25 * std::pow(end, 5.0)));
  }
  append(mesh, sweep(regular_polygon(12), path, sizes, {0, 0, 1}));
  for (const glm::dvec3& end : {a, b})
    for (const double z : {-0.6, 0.6})
      append(mesh, sphere(0.75 * radius, 10, 6), moved(end + glm::dvec3(0, 0, z * radius)));
}

/// A vertebra about the origin: body, two side processes and the spine behind.
Mesh vertebra(double size) {
  Mesh mesh = lathe(Profile{{0.8 * size, -0.42 * size},
                            {size, -0.32 * size},
                            {0.8 * size, 0},
                            {size, 0.32 * size},
                            {0.8 * size, 0.42 * size}},
                    12);
  for (const double z : {-1.0, 1.0})
    append(mesh, tapered_tube(Path{{-0.7 * size, 0, 0.4 * size * z},
                                   {-1.1 * size, 0.1 * size, 1.2 * size * z},
                                   {-1.2 * size, 0.1 * size, 1.8 * size * z}},
                              0.3 * size, 0.18 * size, 7));
  append(mesh, tapered_tube(Path{{-0.8 * size, 0, 0}, {-1.7 * size, -0.2 * size, 0}, {-2.3 * size, -0.6 * size, 0}},
                            0.34 * size, 0.2 * size, 7));
  return mesh;
}

Mesh chest_bones() {
  Mesh mesh;
  for (int k = 0; k < 15; ++k) {
    const double t = k / 14.0, y = -0.1 + 0.54 * t;
    append(mesh, vertebra(0.021 - 0.005 * t), moved({-0.055 + 0.03 * std::sin(pi * t * 1.2), y, 0}));
  }
  // Ten pairs of ribs from the spine round to the breastbone.
  for (int k = 0; k < 10; ++k) {
    const double t = k / 9.0, y = 0.37 - 0.27 * t, wide = 0.085 + 0.05 * std::sin(0.35 + 2.0 * t),
                 deep = 0.075 + 0.03 * std::sin(0.4 + 2.2 * t);
    const double reach = k < 7 ? 0.96 : 0.96 - 0.16 * (k - 6);
    for (const double z : {-1.0, 1.0}) {
      Path rib;
      constexpr int steps = 12;
      for (int i = 0; i <= steps; ++i) {
        const double a = pi * (0.97 - (0.97 - 0.08) * reach * i / steps);
        rib.emplace_back(-0.02 + deep * std::cos(a), y - 0.085 * std::sin(0.5 * pi * i / steps * 1.4),
                         z * wide * std::sin(a));
      }
      append(mesh, sweep(regular_polygon(7), rib, Sizes(rib.size(), glm::dvec2(0.0045, 0.008)), {0, 1, 0}));
    }
  }
  append(mesh, tapered_tube(Path{{0.062, 0.34, 0}, {0.078, 0.25, 0}, {0.085, 0.15, 0}}, 0.016, 0.011, 10));
  for (const double z : {-1.0, 1.0}) {
    add_long_bone(mesh, {0.055, 0.355, 0.02 * z}, {-0.01, chest - 0.025, (shoulder_half - 0.015) * z}, 0.009);
    // The shoulder blade: a thin bent plate.
    append(mesh, sweep(regular_polygon(10),
                       Path{{-0.085, 0.2, 0.075 * z},
                            {-0.095, 0.27, 0.1 * z},
                            {-0.085, 0.34, 0.12 * z},
                            {-0.045, 0.385, 0.165 * z}},
                       Sizes{{0.006, 0.008}, {0.007, 0.042}, {0.007, 0.05}, {0.01, 0.016}}, {0, 0, 1}));
  }
  return mesh;
}

/// The skull: a ball bent into cranium and face, with sockets pressed in, and a jaw.
Mesh skull() {
  Mesh mesh = sphere(1.0, 32, 22);
  for (glm::vec3& v : mesh.positions) {
    const glm::dvec3 d(v);
    glm::dvec3 p = d * glm::dvec3(0.098, 0.085, 0.074);
    p.y += 0.11;
    // The face: narrower and further forward below the brow.
    const double face = glm::smoothstep(0.1, 0.9, d.x) * glm::smoothstep(0.35, -0.6, d.y);
    p.x += 0.012 * face;
    p.z *= 1 - 0.38 * glm::smoothstep(0.0, -0.9, d.y) * glm::smoothstep(-0.6, 0.6, d.x);
    // Eye sockets and the nose, pressed in.
    for (const double z : {-0.36, 0.36}) {
      const double off = glm::length(glm::dvec2(d.y + 0.12, d.z - z)) / 0.26;
      if (d.x > 0) p.x -= 0.034 * (1 - glm::smoothstep(0.35, 1.0, off));
    }
    const double nose = glm::length(glm::dvec2((d.y + 0.5) * 0.7, d.z * 1.4)) / 0.2;
    if (d.x > 0) p.x -= 0.02 * (1 - glm::smoothstep(0.3, 1.0, nose));
    v = glm::vec3(p);
  }
  Path jaw;
  for (int i = 0; i <= 16; ++i) {
    const double a = pi * (i / 16.0 - 0.5);
    const double back = std::pow(std::abs(2.0 * i / 16 - 1), 4.0);
    jaw.emplace_back(-0.005 + 0.085 * std::cos(a), 0.012 + 0.06 * back, 0.052 * std::sin(a));
  }
  append(mesh, sweep(regular_polygon(8), jaw, Sizes(jaw.size(), glm::dvec2(0.008, 0.016))));
  for (int row = 0; row < 2; ++row) {
    for (int k = 0; k < 12; ++k) {
      const double a = pi * ((k + 0.5) / 12 - 0.5) * 0.75;
      append(mesh, sphere(0.0052, 7, 5),
             moved({-0.005 + 0.086 * std::cos(a), row ? 0.043 : 0.031, 0.05 * std::sin(a)}) * scaled({1, 1.4, 1}));
    }
  }
  for (int k = 0; k < 4; ++k) append(mesh, vertebra(0.015), moved({-0.02, -0.075 + 0.032 * k, 0}));
  return mesh;
}

Mesh pelvis_bones() {
  Mesh mesh;
  for (const double z : {-1.0, 1.0}) {
    // The wing of the hip and the ring below it.
    append(mesh, sweep(regular_polygon(12),
                       Path{{-0.07, 0.05, 0.03 * z},
                            {-0.05, 0.075, 0.08 * z},
                            {0.01, 0.075, 0.12 * z},
                            {0.045, 0.03, 0.1 * z},
                            {0.02, -0.01, 0.085 * z}},
                       Sizes{{0.01, 0.02}, {0.01, 0.045}, {0.01, 0.045}, {0.012, 0.03}, {0.025, 0.025}}, {0, 1, 0}));
    append(mesh, torus(0.034, 0.009, 20, 8), moved({0.03, -0.055, 0.045 * z}) * turned_y(0.5 * z) * turned_x(pi / 2));
    append(mesh, sphere(0.026, 14, 10), moved({0, 0, hip_half * z}));
  }
  append(mesh, lathe(Profile{{0, -0.06}, {0.012, -0.05}, {0.03, 0.0}, {0.045, 0.06}, {0.03, 0.075}, {0, 0.08}}, 14),
         moved({-0.07, 0.0, 0}));
  append(mesh, vertebra(0.022), moved({-0.055, 0.1, 0}));
  return mesh;
}

/// Five rays of small bones from `root`, fanned across z, along `axis` and then `tip`.
void add_rays(Mesh& mesh, const glm::dvec3& root, const glm::dvec3& axis, const glm::dvec3& tip, double spread,
              double radius) {
  for (int k = 0; k < 5; ++k) {
    const double u = 0.5 * k - 1.0, length = 1 - 0.12 * u * u;
    const glm::dvec3 fan(0, 0, spread * u);
    const glm::dvec3 a = root + 0.4 * fan, b = a + length * axis + 0.5 * fan, c = b + 0.6 * length * tip + 0.1 * fan,
                     d = c + 0.45 * length * tip;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, d)}) {
      const glm::dvec3 gap = 0.04 * (to - from);
      append(mesh, tube(Path{from + gap, glm::mix(from, to, 0.3), glm::mix(from, to, 0.7), to - gap}, radius, 7));
    }
  }
}

}  // namespace

std::array<Prop, bone_count> skeleton_bones(Scene& scene) {
  std::array<Prop, bone_count> bones;
  const auto set = [&](Bone bone, const char* name, const Mesh& mesh) {
    Prop& prop = bones[static_cast<size_t>(bone)];
    prop.name = name;
    add_part(scene, prop, mesh, color(0xE3DAC3), true);
  };
  set(Bone::pelvis, "pelvis", pelvis_bones());
  set(Bone::chest, "rib cage", chest_bones());
  set(Bone::head, "skull", skull());
  Mesh arm, fore, femur, tibia, foot;
  add_long_bone(arm, {0, -0.01, 0}, {0, -upper_arm + 0.012, 0}, 0.017);
  add_long_bone(fore, {-0.008, -0.012, 0.006}, {0, -forearm + 0.01, 0.016}, 0.011);
  add_long_bone(fore, {0.01, -0.016, -0.004}, {0, -forearm + 0.01, -0.016}, 0.011);
  add_rays(fore, {0, -forearm - 0.012, 0}, {0, -0.062, 0}, {0.012, -0.04, 0}, 0.022, 0.0052);
  add_long_bone(femur, {0, 0, 0.01}, {0, -thigh + 0.022, 0}, 0.023);
  add_long_bone(tibia, {0.006, -0.022, 0.004}, {0, -shin + 0.02, 0.004}, 0.02);
  add_long_bone(tibia, {-0.02, -0.035, -0.022}, {-0.006, -shin + 0.025, -0.024}, 0.009);
  append(foot, sphere(0.03, 14, 10), moved({-0.045, -0.055, 0}) * scaled({1.2, 1.1, 0.85}));
  append(foot, sphere(0.026, 14, 10), moved({0, -0.022, 0}) * scaled({1.2, 1, 1}));
  add_rays(foot, {0.015, -0.045, 0}, {0.085, -0.03, 0}, {0.03, -0.005, 0}, 0.024, 0.008);
  for (const bool left : {true, false}) {
    set(left ? Bone::upper_arm_left : Bone::upper_arm_right, "upper arm", arm);
    set(left ? Bone::forearm_left : Bone::forearm_right, "forearm and hand", fore);
    set(left ? Bone::thigh_left : Bone::thigh_right, "thigh bone", femur);
    set(left ? Bone::shin_left : Bone::shin_right, "shin", tibia);
    set(left ? Bone::foot_left : Bone::foot_right, "foot", foot);
  }
  return bones;
}

}  // namespace shadewright::builtin
