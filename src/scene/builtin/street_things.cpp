#include "scene/builtin/street_things.h"

#include <array>
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

/// Sides of a round thing.
uint32_t sides(int detail, uint32_t at_one) {
  return at_one * static_cast<uint32_t>(1 + detail) / 2;
}

/// A rectangle with rounded corners across x, for the rings of a car's body.
Ring car_ring(double x, double bottom, double top, double half, double round, int corner_steps) {
  Ring ring;
  const glm::dvec2 corners[] = {{half - round, top - round},
                                {-half + round, top - round},
                                {-half + round, bottom + round},
                                {half - round, bottom + round}};
  for (int c = 0; c < 4; ++c) {
    for (int i = 0; i <= corner_steps; ++i) {
      const double a = pi / 2 * (c + double(i) / corner_steps);
      const glm::dvec2 p = corners[c] + round * glm::dvec2(std::cos(a), std::sin(a));
      ring.emplace_back(x, p.y, -p.x);
    }
  }
  return ring;
}

}  // namespace

Prop street_lamp(Scene& scene, int detail) {
  Prop prop;
  prop.name = "street lamp";
  const Profile pole = {{0.16, -0.1}, {0.16, 0.25}, {0.11, 0.35}, {0.085, 1.2}, {0.06, 4.6}, {0, 4.7}};
  Mesh iron = lathe(pole, sides(detail, 7));
  const Path arm = smooth_path(
      std::array{glm::dvec3(0, 4.3, 0), glm::dvec3(0.1, 4.95, 0), glm::dvec3(0.6, 5.2, 0), glm::dvec3(1.15, 5.0, 0)},
      static_cast<uint32_t>(1 + detail));
  append(iron, tapered_tube(arm, 0.05, 0.035, sides(detail, 5)));
  append(iron, cone(0.28, 0.06, 0.24, sides(detail, 8)), moved({1.15, 4.82, 0}));
  add_part(scene, prop, std::move(iron), color(0x3E4A48));
  add_part(scene, prop, sphere(0.17, sides(detail, 7), sides(detail, 4)), color(0xF2E9C8));
  scene.meshes.back() = transformed(scene.meshes.back(), moved({1.15, 4.78, 0}));
  return prop;
}

Prop bench(Scene& scene, int detail) {
  Prop prop;
  prop.name = "bench";
  Mesh planks, legs;
  const int count = 2 + detail;
  for (int k = 0; k < count; ++k) {
    const double z = -0.2 + 0.42 * k / (count - 1), gap = 0.36 / count;
    append(planks, box({-0.8, 0.43, z - 0.5 * gap}, {0.8, 0.47, z + 0.5 * gap}));
    if (k > 0)
      append(planks, box({-0.8, -0.05, -0.02}, {0.8, 0.05, 0.015}),
             moved({0, 0.5 + 0.36 * k / (count - 1), -0.27 - 0.07 * k / (count - 1)}) * turned_x(-0.2));
  }
  for (const double x : {-0.62, 0.62}) {
    append(legs, beam({x, -0.03, 0.2}, {x, 0.44, 0.17}, 0.06, 0.06));
    append(legs, beam({x, -0.03, -0.3}, {x, 0.44, -0.2}, 0.06, 0.06));
    append(legs, beam({x, 0.40, -0.24}, {x, 0.92, -0.37}, 0.05, 0.05));
    append(legs, box({x - 0.028, 0.39, -0.24}, {x + 0.028, 0.435, 0.21}));
  }
  add_part(scene, prop, std::move(planks), color(0x9C6B42));
  add_part(scene, prop, std::move(legs), color(0x43484A));
  return prop;
}

Prop bollard(Scene& scene, int detail) {
  Prop prop;
  prop.name = "bollard";
  const Profile profile = {{0.11, -0.1},  {0.11, 0.08}, {0.08, 0.12}, {0.075, 0.68},
                           {0.095, 0.72}, {0.09, 0.82}, {0.05, 0.9},  {0, 0.92}};
  const Profile plain = {{0.1, -0.1}, {0.08, 0.7}, {0.095, 0.82}, {0, 0.92}};
  add_part(scene, prop, lathe(detail == 1 ? plain : profile, sides(detail, 8)), color(0x4A4F50));
  return prop;
}

Prop bin(Scene& scene, int detail) {
  Prop prop;
  prop.name = "bin";
  const Profile profile = {{0.2, -0.03}, {0.22, 0.05}, {0.26, 0.75}, {0.29, 0.77},
                           {0.29, 0.83}, {0.24, 0.83}, {0.2, 0.15},  {0, 0.12}};
  add_part(scene, prop, lathe(profile, sides(detail, 9)), color(0x4F6B4C));
  return prop;
}

Prop fountain(Scene& scene, int detail) {
  Prop prop;
  prop.name = "fountain";
  const Profile basin = {{2.5, -0.1},  {2.6, 0.1},  {2.45, 0.2}, {2.45, 0.5}, {2.6, 0.6},
                         {2.55, 0.68}, {2.2, 0.68}, {2.15, 0.3}, {0, 0.28}};
  Mesh stone = lathe(basin, sides(detail, 16));
  const Profile stem = {{0.5, 0.2},   {0.35, 0.5},  {0.2, 0.9},   {0.18, 1.3}, {0.3, 1.5},  {1.1, 1.75},
                        {1.15, 1.84}, {1.05, 1.86}, {0.25, 1.68}, {0.13, 1.9}, {0.12, 2.3}, {0.25, 2.45},
                        {0.6, 2.58},  {0.6, 2.64},  {0.15, 2.6},  {0.08, 2.9}, {0, 3.0}};
  append(stone, lathe(stem, sides(detail, 10)));
  add_part(scene, prop, std::move(stone), color(0xC9C2B2));
  add_part(scene, prop, transformed(cylinder(2.18, 0.3, sides(detail, 16)), moved({0, 0.2, 0})), color(0x5F8FA0));
  return prop;
}

Prop car(Scene& scene, int detail, Random& random) {
  Prop prop;
  prop.name = "car";
  const int steps = detail;
  const double length = random.range(3.9, 4.4), roof = random.range(1.38, 1.52), half = 0.84;
  const bool estate = random.chance(0.4);
  const double tail = -0.5 * length, nose = 0.5 * length;
  // Rings from tail to nose: x, bottom, top, half width.
  const std::array<glm::dvec4, 8> body = {glm::dvec4(tail, 0.42, 0.78, half - 0.12),
                                          {tail + 0.1, 0.3, 0.9, half - 0.03},
                                          {tail + 0.5, 0.24, 0.96, half},
                                          {-0.3, 0.22, 0.97, half + 0.01},
                                          {0.75, 0.22, 0.95, half},
                                          {nose - 0.55, 0.24, 0.86, half - 0.02},
                                          {nose - 0.12, 0.28, 0.74, half - 0.08},
                                          {nose, 0.38, 0.62, half - 0.18}};
  std::vector<Ring> rings;
  for (const glm::dvec4& b : body) rings.push_back(car_ring(b.x, b.y, b.z, b.w, 0.11, steps));
  Mesh shell = loft(rings);
  const double rear = estate ? tail + 0.12 : tail + 0.62;
  const std::array<glm::dvec4, 4> cabin = {glm::dvec4(rear, 0.85, 0.97, half - 0.12),
                                           {rear + 0.42, 0.85, roof - 0.03, half - 0.2},
                                           {0.15, 0.85, roof, half - 0.2},
                                           {0.95, 0.8, 0.93, half - 0.13}};
  std::vector<Ring> glass, top;
  for (const glm::dvec4& b : cabin) glass.push_back(car_ring(b.x, b.y, b.z, b.w, 0.05, steps));
  // The roof panel is a thin lid over the glass, with two pillars' worth of overlap at its ends.
  top.push_back(car_ring(rear + 0.36, roof - 0.12, roof + 0.0, half - 0.19, 0.045, steps));
  top.push_back(car_ring(-0.5 + 0.2 * rear * 0.2, roof - 0.07, roof + 0.035, half - 0.17, 0.045, steps));
  top.push_back(car_ring(0.22, roof - 0.1, roof + 0.012, half - 0.19, 0.045, steps));
  append(shell, loft(top));
  for (const double side : {-1.0, 1.0}) {
    append(shell, beam({-0.25, 0.9, side * (half - 0.1)}, {-0.25, roof - 0.03, side * (half - 0.195)}, 0.09, 0.05));
    if (detail > 1)
      append(shell, slab({0.62, 0.92, side * (half + 0.1) - 0.1}, {0.76, 1.05, side * (half + 0.1) + 0.08}, 0.03));
  }
  add_part(scene, prop, std::move(shell), color(0xB23B32), true);
  add_part(scene, prop, loft(glass), color(0x2E3A44));

  Mesh tyres, hubs, trim;
  const Profile tyre = {{0.19, -0.1},  {0.28, -0.11}, {0.315, -0.07}, {0.32, 0},
                        {0.315, 0.07}, {0.28, 0.11},  {0.19, 0.1}};
  const Profile plain_tyre = {{0.32, -0.1}, {0.32, 0.1}}, plain_hub = {{0.2, -0.07}, {0.17, 0.115}};
  const Profile hub = {{0.2, -0.07}, {0.2, 0.07}, {0.07, 0.085}, {0, 0.085}};
  for (const double x : {tail + 0.78, nose - 0.78}) {
    for (const double side : {-1.0, 1.0}) {
      const glm::dmat4 at = moved({x, 0.316, side * (half - 0.06)}) * turned_x(side * pi / 2);
      append(tyres, detail == 1 ? lathe(plain_tyre, 10) : lathe_ring(tyre, sides(detail, 12)), at);
      append(hubs, detail == 1 ? lathe(plain_hub, 7) : lathe(hub, sides(detail, 8)), at);
    }
  }
  add_part(scene, prop, std::move(tyres), color(0x2B2B2C));
  add_part(scene, prop, std::move(hubs), color(0xB9BCC0));
  for (const double side : {-1.0, 1.0}) {
    append(trim, sphere(0.11, detail == 1 ? 6 : 10, detail == 1 ? 3 : 6),
           moved({nose - 0.09, 0.62, side * (half - 0.3)}) * scaled({0.6, 0.8, 1.3}));
    append(trim, box({tail - 0.012, 0.62, side * (half - 0.24) - 0.1}, {tail + 0.1, 0.76, side * (half - 0.24) + 0.1}));
  }
  append(trim, slab({nose - 0.16, 0.4, -half + 0.16}, {nose + 0.06, 0.5, half - 0.16}, 0.02));
  append(trim, slab({tail - 0.06, 0.42, -half + 0.12}, {tail + 0.14, 0.54, half - 0.12}, 0.02));
  add_part(scene, prop, std::move(trim), color(0xD8D4CC));
  return prop;
}

}  // namespace shadewright::builtin
