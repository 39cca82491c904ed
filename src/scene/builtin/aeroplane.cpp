#include "scene/builtin/aeroplane.h"

#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/loft.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/sweep.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;

/// A wing's section: leading edge at +x, `chord` long, closed, counter-clockwise seen from +z.
Ring airfoil(double chord, double thickness, double x, double y, double z) {
  Ring ring;
  constexpr int steps = 8;
  const auto half = [&](double t) { return thickness * (2.2 * std::sqrt(t) - 1.5 * t - 0.7 * t * t) + 0.004; };
  for (int i = 0; i < steps; ++i) {
    const double t = double(i) / steps;
    ring.emplace_back(x - chord * t, y + half(t) + 0.02 * chord * std::sin(pi * t), z);
  }
  for (int i = steps; i > 0; --i) {
    const double t = double(i) / steps;
    ring.emplace_back(x - chord * t, y - 0.6 * half(t) + 0.02 * chord * std::sin(pi * t), z);
  }
  return ring;
}

/// A wing along z from -half to half, rounded at its tips.
Mesh wing(double half, double chord, double thickness, double x, double y, double dihedral) {
  std::vector<Ring> rings;
  for (const double u : {-1.0, -0.97, -0.88, -0.6, -0.3, 0.0, 0.3, 0.6, 0.88, 0.97, 1.0}) {
    const double a = std::abs(u), shrink = a > 0.88 ? (a > 0.99 ? 0.45 : (a > 0.95 ? 0.8 : 1.0)) : 1.0;
    rings.push_back(
        airfoil(chord * shrink, thickness * shrink, x - 0.25 * chord * (1 - shrink), y + dihedral * a, half * u));
  }
  return loft(rings);
}

}  // namespace

Prop aeroplane(Scene& scene) {
  Prop prop;
  prop.name = "aeroplane";
  const Path spine = {{2.75, 0, 0},    {2.65, 0, 0},  {2.2, 0, 0},     {1.5, 0.02, 0}, {0.6, 0.05, 0},
                      {-0.6, 0.05, 0}, {-2, 0.12, 0}, {-3.3, 0.22, 0}, {-3.6, 0.25, 0}};
  const Sizes size = {{0.25, 0.25}, {0.38, 0.38}, {0.46, 0.48}, {0.46, 0.52}, {0.45, 0.55},
                      {0.42, 0.5},  {0.28, 0.34}, {0.1, 0.18},  {0.03, 0.08}};
  add_part(scene, prop, sweep(regular_polygon(18), spine, size), color(0xE3DDCB));

  Mesh wings = wing(4.3, 1.25, 0.06, 1.55, 1.25, 0.12);
  append(wings, wing(4.0, 1.2, 0.06, 1.2, -0.32, 0.16));
  append(wings, wing(1.5, 0.85, 0.03, -2.75, 0.28, 0.0));
  append(wings, wing(0.72, 0.85, 0.03, -2.85, 0.0, 0.0), moved({0, 0.85, 0}) * turned_x(pi / 2));
  add_part(scene, prop, std::move(wings), color(0xC0392B), true);

  Mesh struts, wheels;
  for (const double side : {-1.0, 1.0}) {
    for (const double z : {1.0, 3.2}) {
      for (const double x : {0.5, 1.1})
        append(struts, rod({x - 0.1, -0.28, side * z}, {x + 0.2, 1.3, side * z}, 0.035, 8));
      append(struts, rod({0.75, -0.25, side * (z - 0.9)}, {0.9, 1.28, side * z}, 0.009, 6));
      append(struts, rod({0.75, 1.27, side * (z - 0.9)}, {0.9, -0.2, side * z}, 0.009, 6));
    }
    for (const double x : {0.7, 1.3})
      append(struts, rod({x, 0.35, side * 0.3}, {x + 0.08, 1.28, side * 0.55}, 0.03, 8));
    append(struts, rod({1.1, -0.3, side * 0.3}, {1.3, -1.05, side * 0.8}, 0.04, 8));
    append(struts, rod({1.7, -0.3, side * 0.3}, {1.3, -1.05, side * 0.8}, 0.035, 8));
    append(wheels, torus(0.24, 0.09, 24, 10), moved({1.3, -1.05, side * 0.86}) * turned_x(pi / 2));
    append(wheels, cylinder(0.19, 0.06, 16), moved({1.3, -1.05, side * 0.86 - 0.03}) * turned_x(pi / 2));
  }
  append(struts, rod({1.3, -1.05, -0.95}, {1.3, -1.05, 0.95}, 0.03, 8));
  append(wheels, lathe(Profile{{0.16, 0}, {0.15, 0.12}, {0.08, 0.24}, {0, 0.28}}, 16), along({2.72, 0, 0}, {1, 0, 0}));
  // Two propeller blades, twisted.
  std::vector<Ring> blade;
  for (int i = -6; i <= 6; ++i) {
    const double r = 0.17 * i, a = std::abs(r), width = 0.05 + 0.09 * std::sin(std::min(1.0, a) * pi * 0.85),
                 turn = 1.1 - 0.7 * a;
    const glm::dvec3 across(std::sin(turn) * width * (i < 0 ? -1 : 1), std::cos(turn) * width, 0), thick(0.018, 0, 0);
    const glm::dvec3 c(2.84, 0, r);
    blade.push_back({c - across - thick, c + across - thick, c + across + thick, c - across + thick});
  }
  if (glm::dot(glm::cross(blade[0][1] - blade[0][0], blade[0][2] - blade[0][0]), blade[1][0] - blade[0][0]) < 0)
    for (Ring& ring : blade) std::swap(ring[1], ring[3]);
  append(wheels, loft(blade));
  add_part(scene, prop, std::move(struts), color(0x8A7A60));
  add_part(scene, prop, std::move(wheels), color(0x3A3836));
  // Wind shield and cockpit rim, the pilot's head.
  Mesh cockpit = torus(0.3, 0.045, 20, 8);
  append(cockpit, sphere(0.14, 14, 10), moved({-0.05, 0.28, 0}));
  append(cockpit, slab({0.33, -0.1, -0.28}, {0.36, 0.24, 0.28}, 0.01), turned_z(0.5));
  add_part(scene, prop, transformed(cockpit, moved({-0.35, 0.58, 0})), color(0x5A4030));
  return prop;
}

}  // namespace shadewright::builtin
