#include "scene/builtin/roof.h"

#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/extrude.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/sweep.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;

/// Extrudes a polygon of (z, y) along x.
Mesh along_x(const Polygon& profile, double from, double to) {
  return transformed(extrude(profile, from, to), turned_y(-pi / 2) * scaled({1, 1, -1}));
}

/// A roof of two slopes over a span of 2 half, ridge along x at `rise` above 0, with eaves that hang over.
Mesh chevron(double half, double rise, double thickness, double overhang, double from, double to) {
  const double slope = rise / half, z = half + overhang, drop = slope * overhang;
  const Polygon profile = {{-z, -drop},           {0, rise}, {z, -drop}, {z, thickness - drop}, {0, rise + thickness},
                           {-z, thickness - drop}};
  Polygon turned(profile.rbegin(), profile.rend());
  double area = 0;
  for (size_t i = 0; i < profile.size(); ++i) {
    const glm::dvec2 a = profile[i], b = profile[(i + 1) % profile.size()];
    area += a.x * b.y - a.y * b.x;
  }
  return along_x(area > 0 ? profile : turned, from, to);
}

void add_chimney(Mesh& bricks, Mesh& pots, const glm::dvec3& foot, double height) {
  append(bricks, box({-0.3, 0, -0.45}, {0.3, height, 0.45}), moved(foot));
  append(bricks, slab({-0.37, height - 0.18, -0.52}, {0.37, height + 0.05, 0.52}, 0.04), moved(foot));
  for (const double z : {-0.22, 0.22}) append(pots, pipe(0.09, 0.13, 0.5, 8), moved(foot + glm::dvec3(0, height, z)));
}

void add_dormer(Mesh& roof, Mesh& walls, Mesh& glass, double x, double y, double z, double depth) {
  append(walls, box({x - 0.65, y - 0.5, z - depth}, {x + 0.65, y + 1.3, z}));
  append(glass, box({x - 0.45, y + 0.25, z - 0.2}, {x + 0.45, y + 1.15, z + 0.03}));
  append(roof, chevron(0.65, 0.55, 0.12, 0.18, -0.25, depth), moved({x, y + 1.28, z}) * turned_y(pi / 2));
}

void add_pitched(Scene& scene, Prop& prop, const HouseShape& shape, double eaves, Random& random) {
  const double w = shape.width, d = shape.depth, half = 0.5 * d, rise = half * random.range(0.75, 1.05);
  const glm::vec3 tiles = color(std::array{0xA8553Cu, 0x8C4A3Au, 0x6B6460u, 0xB0694Au}[random.index(4)]);
  Mesh roof, gables, bricks, pots, glass, gutters;
  if (shape.roof == Roof::gable) {
    roof = chevron(half, rise, 0.22, 0.45, -0.5 * w - 0.3, 0.5 * w + 0.3);
    append(roof, rod({-0.5 * w - 0.32, rise + 0.2, 0}, {0.5 * w + 0.32, rise + 0.2, 0}, 0.1, 8));
    const Polygon gable = {
        {-half + 0.06, -0.35}, {half - 0.06, -0.35}, {half - 0.06, 0.06}, {0, rise + 0.08}, {-half + 0.06, 0.06}};
    for (const double side : {-1.0, 1.0})
      append(gables, along_x(gable, side * (0.5 * w - 0.2) - 0.16, side * (0.5 * w - 0.2) + 0.16));
    if (shape.detail >= 3) {
      // Courses of tiles across both slopes.
      const int courses = static_cast<int>(half / 0.38);
      for (int k = 0; k < courses; ++k) {
        const double t = (k + 0.5) / courses, z = (half + 0.4) * (1 - t), y = rise - z * rise / half + 0.235;
        for (const double side : {-1.0, 1.0})
          append(roof, rod({-0.5 * w - 0.28, y, side * z}, {0.5 * w + 0.28, y, side * z}, 0.05, 5));
      }
    }
  } else {
    const double ridge = std::max(0.3, 0.5 * w - 0.8 * half);
    append(roof, slab({-0.5 * w - 0.42, -0.16, -half - 0.42}, {0.5 * w + 0.42, 0.1, half + 0.42}, 0.05));
    append(roof, tapered_box({0.5 * w + 0.3, half + 0.3}, {ridge, 0.08}, rise * 0.85), moved({0, 0.06, 0}));
  }
  if (shape.detail >= 2) {
    const double z = half + 0.47, drop = shape.roof == Roof::gable ? rise / half * 0.45 : 0.05;
    for (const double side : {-1.0, 1.0}) {
      append(gutters, rod({-0.5 * w - 0.25, -drop, side * z}, {0.5 * w + 0.25, -drop, side * z}, 0.075, 8));
      append(gutters, tube(std::array{glm::dvec3(-0.5 * w + 0.25, -drop, side * z),
                                      glm::dvec3(-0.5 * w + 0.25, -drop - 0.25, side * (half + 0.1)),
                                      glm::dvec3(-0.5 * w + 0.25, -eaves - 0.1, side * (half + 0.1))},
                           0.05, 6));
    }
    if (shape.roof == Roof::gable && random.chance(0.65)) {
      const int count = w > 8 ? 2 : 1;
      for (int k = 0; k < count; ++k) {
        const double x = w * ((k + 0.5) / count - 0.5) * 0.8, z0 = half * 0.62;
        add_dormer(roof, gables, glass, x, rise - z0 * rise / half, z0, z0 * 0.95);
      }
    }
  }
  const int chimneys = 1 + static_cast<int>(random.index(2));
  for (int k = 0; k < chimneys; ++k) {
    const double x = (k == 0 ? -1 : 1) * w * random.range(0.18, 0.36), z = half * random.range(-0.45, -0.2);
    add_chimney(bricks, pots, {x, rise * 0.45, z}, rise * 0.55 + random.range(0.7, 1.3));
  }
  const glm::dmat4 up = moved({0, eaves, 0});
  add_part(scene, prop, transformed(roof, up), tiles);
  add_part(scene, prop, transformed(gables, up), color(0xCDBFA6), true);
  add_part(scene, prop, transformed(bricks, up), color(0x9A5B45));
  add_part(scene, prop, transformed(pots, up), color(0xB8744F));
  add_part(scene, prop, transformed(glass, up), color(0x39424C));
  add_part(scene, prop, transformed(gutters, up), color(0x75777A));
}

void add_flat(Scene& scene, Prop& prop, const HouseShape& shape, double eaves, Random& random) {
  const double hw = 0.5 * shape.width, hd = 0.5 * shape.depth;
  Mesh deck = box({-hw + 0.1, eaves - 0.3, -hd + 0.1}, {hw - 0.1, eaves + 0.05, hd - 0.1});
  add_part(scene, prop, std::move(deck), color(0x8F8B84));
  // A coping round the parapet: a mitred ring would need equal sides, so four slabs that lap at different heights.
  Mesh coping;
  for (const double s : {-1.0, 1.0}) {
    append(coping, slab({-hw - 0.06, eaves + 0.7, s * (hd - 0.16) - 0.22},
                        {hw + 0.06, eaves + 0.86, s * (hd - 0.16) + 0.22}, 0.03));
    append(coping, slab({s * (hw - 0.18) - 0.21, eaves + 0.69, -hd + 0.2},
                        {s * (hw - 0.18) + 0.21, eaves + 0.84, hd - 0.2}, 0.03));
  }
  add_part(scene, prop, std::move(coping), color(0xDAD3C4));
  Mesh hut = box({-1.3, 0, -1.2}, {1.3, 2.3, 1.2});
  append(hut, slab({-1.45, 2.25, -1.35}, {1.45, 2.45, 1.35}, 0.05));
  const double side = random.chance(0.5) ? 1 : -1;
  add_part(scene, prop, transformed(hut, moved({side * hw * 0.35, eaves, -hd * 0.3})), color(0xB9AE9C), true);
  // A water tank on four legs, and ventilators.
  Mesh tank = lathe(Profile{{0.95, 1.2}, {0.95, 2.9}, {0.7, 3.2}, {0, 3.4}}, 14);
  for (int k = 0; k < 4; ++k) {
    const double a = pi * (0.25 + 0.5 * k);
    append(tank,
           rod({0.75 * std::cos(a), 0, 0.75 * std::sin(a)}, {0.75 * std::cos(a), 1.3, 0.75 * std::sin(a)}, 0.07, 6));
  }
  if (shape.floors >= 4)
    add_part(scene, prop, transformed(tank, moved({-side * hw * 0.45, eaves, -hd * 0.35})), color(0x8A6A50));
  Mesh vents;
  for (int k = 0; k < 1 + 2 * shape.detail; ++k) {
    const glm::dvec3 at(hw * random.range(-0.7, 0.7), eaves, hd * (0.1 + 0.6 * random.unit()));
    append(vents, random.chance(0.5) ? slab({-0.45, 0, -0.3}, {0.45, 0.65, 0.3}, 0.04) : cone(0.16, 0.2, 0.9, 10),
           moved(at) * turned_y(0.2 * k));
  }
  add_part(scene, prop, std::move(vents), color(0xA9ACAE));
}

}  // namespace

void add_roof(Scene& scene, Prop& prop, const HouseShape& shape, double eaves, Random& random) {
  if (shape.roof == Roof::flat)
    add_flat(scene, prop, shape, eaves, random);
  else
    add_pitched(scene, prop, shape, eaves, random);
}

}  // namespace shadewright::builtin
