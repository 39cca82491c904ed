// A small town in the country: a market square with a church, rings of houses, gardens, fields and woods (the town of
// RTW): larger than the city, with near and far detail in one view. Closed throughout.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/budget.h"
#include "scene/builtin/house.h"
#include "scene/builtin/random.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/extrude.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/panel.h"
#include "scene/builtin/street_things.h"
#include "scene/builtin/tree.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr size_t total_triangles = 528000;
constexpr double square_radius = 24, ring_width = 7;
constexpr std::array<double, 3> rings = {50, 92, 138};  // middle radius of each ring road
constexpr int spokes = 6;

constexpr std::array<uint32_t, 8> plasters = {0xE3DCCB, 0xD9C7A3, 0xC98F6B, 0xE6E0D6,
                                              0xD8B98C, 0xC9B7A0, 0xB7A08C, 0xDDD2BE};
constexpr std::array<uint32_t, 5> greens = {0x6F9A45, 0x5C8A3C, 0x86A84E, 0x9AA64A, 0x577F4A};

template <size_t N>
glm::vec3 pick(const std::array<uint32_t, N>& palette, Random& random) {
  return shade(color(palette[random.index(N)]), random.range(0.9, 1.08));
}

glm::dmat4 polar(double radius, double angle) {
  return turned_y(-angle) * moved({radius, 0, 0});
}

/// Roads lie at different heights where they cross, so that no two tops share a plane.
void add_roads(Scene& scene) {
  const glm::vec3 road = color(0x8A8580);
  place(scene, "fields", transformed(cylinder(420, 3, 96), moved({0, -3, 0})), color(0x93A566));
  place(
      scene, "market square",
      transformed(lathe(Profile{{square_radius + 0.1, -0.3}, {square_radius, 0.12}, {0, 0.14}}, 64), moved({0, 0, 0})),
      color(0xB3A795));
  for (const double radius : rings) {
    const double in = radius - 0.5 * ring_width, out = radius + 0.5 * ring_width;
    place(scene, "ring road", lathe_ring(Profile{{out, -0.3}, {out - 0.06, 0.05}, {in + 0.06, 0.05}, {in, -0.3}}, 96),
          road);
  }
  for (int k = 0; k < spokes; ++k)
    place(scene, "road",
          transformed(slab({square_radius - 2, -0.3, -2.8}, {400, 0.085, 2.8}, 0.05),
                      turned_y(-2 * pi * k / spokes - 0.2)),
          shade(road, 0.96));
}

/// Nave, tower, spire and buttresses; the nave along X, its end with the tower at -X.
Prop church(Scene& scene) {
  Prop prop;
  prop.name = "church";
  Mesh walls, roof, glass, stone;
  std::vector<double> xs = {-11}, ys = {-0.4, 2.2, 6.6, 8};
  for (int k = 0; k < 6; ++k) {
    xs.push_back(-9.2 + 3.6 * k);
    xs.push_back(-8.0 + 3.6 * k);
  }
  xs.push_back(12);
  const auto side = panel(xs, ys, -0.6, 0, [](size_t i, size_t j) { return i % 2 == 0 || j != 1; });
  append(walls, side, moved({0, 0, 5}));
  append(walls, transformed(side, turned_y(pi)), moved({1.013, 0, -5.02}));
  append(walls, box({11.2, -0.4, -4.7}, {11.8, 8.03, 4.7}));
  append(glass, box({-10.5, -0.3, -4.6}, {11.3, 7.6, 4.6}));
  const Polygon gable = {{-4.9, 7.4}, {4.9, 7.4}, {4.9, 7.9}, {0, 12.9}, {-4.9, 7.9}};
  append(walls, transformed(extrude(gable, 11.1, 11.75), turned_y(-pi / 2) * scaled({1, 1, -1})));
  const Polygon slates = {{5.6, 7.3}, {0, 13.0}, {-5.6, 7.3}, {-5.6, 7.65}, {0, 13.4}, {5.6, 7.65}};
  Polygon forward(slates.rbegin(), slates.rend());
  append(roof, transformed(extrude(forward, -11.6, 12.3), turned_y(-pi / 2) * scaled({1, 1, -1})));
  for (int k = 0; k < 7; ++k)
    for (const double z : {-1.0, 1.0})
      append(stone, tapered_box({0.35, 0.9}, {0.3, 0.25}, 7.0), moved({-10.4 + 3.6 * k, -0.3, z * 5.3}));
  // The tower: a pierced belfry on a shaft, a spire of eight sides.
  append(walls, box({-16.6, -0.4, -3.1}, {-10.4, 17, 3.1}));
  append(stone, slab({-16.9, 16.8, -3.4}, {-10.1, 17.4, 3.4}, 0.15));
  const std::array<double, 6> bx = {-2.9, -1.9, -0.5, 0.5, 1.9, 2.9};
  const std::array<double, 4> by = {17.2, 18.4, 21.4, 22.6};
  for (int k = 0; k < 4; ++k)
    append(
        walls,
        panel(bx, by, k % 2 ? 2.2 : 2.25, k % 2 ? 2.7 : 2.9, [](size_t i, size_t j) { return j != 1 || i % 2 == 0; }),
        moved({-13.5, 0, 0}) * turned_y(k * pi / 2) * scaled({k % 2 ? 0.8 : 1.0, 1, 1}));
  append(stone, slab({-16.7, 22.4, -3.2}, {-10.3, 22.9, 3.2}, 0.1));
  append(roof, cone(3.0, 0, 14, 8), moved({-13.5, 22.7, 0}));
  append(stone, sphere(0.35, 12, 8), moved({-13.5, 36.5, 0}));
  append(stone, box({-13.54, 36.6, -0.06}, {-13.46, 38.4, 0.06}));
  append(stone, box({-13.52, 37.5, -0.5}, {-13.48, 37.65, 0.5}));
  append(stone, slab({-17.6, -0.3, -1.6}, {-16.4, 0.25, 1.6}, 0.03));
  append(glass, box({-16.68, 0.2, -0.95}, {-16.5, 3.2, 0.95}));
  add_part(scene, prop, std::move(walls), color(0xCFC3A8));
  add_part(scene, prop, std::move(roof), color(0x5F6A70));
  add_part(scene, prop, std::move(glass), color(0x39424C));
  add_part(scene, prop, std::move(stone), color(0xB9AD94));
  return prop;
}

/// A market stall with a striped awning on four posts.
Prop stall(Scene& scene) {
  Prop prop;
  prop.name = "stall";
  Mesh wood;
  for (const double x : {-1.3, 1.3})
    for (const double z : {-0.8, 0.8}) append(wood, beam({x, -0.05, z}, {x, z > 0 ? 2.1 : 2.5, z}, 0.08, 0.08));
  append(wood, slab({-1.4, 0.85, -0.3}, {1.4, 0.92, 0.85}, 0.01));
  append(wood, box({-1.35, 0.05, 0.72}, {1.35, 0.86, 0.76}));
  Mesh stripes[2];
  for (int k = 0; k < 8; ++k)
    append(stripes[k % 2], beam({-1.33 + 0.38 * k, 2.56, -1.0}, {-1.33 + 0.38 * k, 2.02, 1.15}, 0.376, 0.03));
  add_part(scene, prop, std::move(wood), color(0x9A7450));
  add_part(scene, prop, std::move(stripes[0]), color(0xB8453A), true);
  add_part(scene, prop, std::move(stripes[1]), color(0xEAE3D2));
  return prop;
}

/// A clipped hedge: a long lump with a flat top, 4 m along X.
Mesh hedge(Random& random) {
  Mesh mesh = lump({0, 0.45, 0}, {2.05, 0.75, 0.42}, 16, 9, 0.06, random);
  for (glm::vec3& p : mesh.positions) p.y = std::min(p.y, 1.0f + 0.05f * (p.y - 1.0f));
  return mesh;
}

struct Kit {
  std::vector<Prop> houses, trees, woods, cars;
  std::vector<double> widths;
  Prop lamp, seat, hedge_row, shrub;
};

Kit make_kit(Scene& scene, Random& random) {
  Kit kit;
  for (size_t k = 0; k < 8; ++k) {
    HouseShape shape;
    shape.width = random.range(8, 12.5);
    shape.depth = random.range(8.5, 10);
    shape.floors = 1 + static_cast<int>(k % 3);
    shape.roof = k % 3 == 1 ? Roof::hip : Roof::gable;
    shape.detail = k % 4 == 1 ? 2 : 1;
    kit.houses.push_back(house(scene, shape, random));
    kit.widths.push_back(shape.width);
  }
  for (int k = 0; k < 5; ++k) {
    TreeShape shape;
    shape.height = random.range(6.5, 11);
    shape.spread = 0.32 * shape.height;
    shape.crown = Crown::leaves;
    shape.leaf_count = 340;
    shape.leaf_size = 0.6;
    kit.trees.push_back(k == 4 ? conifer(scene, shape, random) : broadleaf_tree(scene, shape, random));
  }
  // Woods are far: lumps will do.
  for (int k = 0; k < 5; ++k) {
    TreeShape shape;
    shape.height = random.range(8, 13);
    shape.spread = 0.3 * shape.height;
    kit.woods.push_back(k == 4 ? conifer(scene, shape, random) : broadleaf_tree(scene, shape, random));
  }
  for (int k = 0; k < 2; ++k) kit.cars.push_back(car(scene, 1, random));
  kit.lamp = street_lamp(scene, 2);
  kit.seat = bench(scene, 2);
  kit.hedge_row.name = "hedge";
  add_part(scene, kit.hedge_row, hedge(random), color(0x5C8040), true);
  kit.shrub = bush(scene, 1.1, color(0x6B8F48), random);
  return kit;
}

void add_square(Scene& scene, Budget& budget, const Kit& kit, Random& random) {
  const Prop basin = fountain(scene, 3), booth = stall(scene), nave = church(scene);
  budget.add(nave, moved({-1, 0.1, -10}) * turned_y(0.12));
  budget.add(basin, moved({6, 0.12, 8}));
  constexpr std::array<uint32_t, 4> awnings = {0xB8453A, 0x3F7CAC, 0x4E8F5A, 0xD9A441};
  for (int k = 0; k < 7; ++k)
    budget.add(booth,
               moved({-13.5 + 4.6 * k - (k > 3 ? 0.0 : 1.5), 0.12, 3.5 + 12 * (k % 2)}) *
                   turned_y(random.range(-0.3, 0.3) + (k % 2 ? pi : 0)),
               color(awnings[random.index(4)]));
  for (int k = 0; k < 10; ++k) {
    const double a = 2 * pi * (k + 0.5) / 10;
    budget.add(kit.lamp, polar(square_radius - 1.6, a) * moved({0, 0.12, 0}) * turned_y(pi));
    if (k % 2) budget.add(kit.seat, polar(square_radius - 3, a + 0.2) * moved({0, 0.12, 0}) * turned_y(-pi / 2));
  }
}

/// True where a spoke road passes within `clear` metres of the direction `angle` at `radius`.
bool on_spoke(double radius, double angle, double clear) {
  const double sector = 2 * pi / spokes, off = angle - 0.2 - sector * std::round((angle - 0.2) / sector);
  return std::abs(off) * radius < clear;
}

/// Houses, gardens, lamps and cars along both sides of a ring road.
void add_ring(Budget& budget, const Kit& kit, double radius, Random& random) {
  for (const double side : {-1.0, 1.0}) {
    const double line = radius + side * (0.5 * ring_width + 8.5);
    double angle = random.range(0, 0.1);
    while (angle < 2 * pi) {
      const size_t k = random.index(static_cast<uint32_t>(kit.houses.size()));
      const double half = 0.5 * kit.widths[k], front = line - side * 5;
      angle += (half + 1.5) / std::min(line, front);
      if (angle > 2 * pi - half / front) break;
      if (!on_spoke(front, angle, half + 4.5)) {
        // Fronts face the road.
        const glm::dmat4 plot = polar(line, angle) * turned_y(side > 0 ? -pi / 2 : pi / 2);
        budget.add(kit.houses[k],
                   plot * moved({0, 0.05, random.range(-0.6, 0.6)}) * turned_y(random.range(-0.04, 0.04)),
                   pick(plasters, random));
        for (int i = 0; i < 2; ++i)
          budget.add(kit.hedge_row,
                     plot * moved({half * (i ? 1 : -1) * 1.1, 0, -9 - 2.0 * i}) * turned_y(i ? pi / 2 : 0.1),
                     pick(greens, random));
        if (random.chance(0.8)) {
          const Prop& tree = kit.trees[random.index(static_cast<uint32_t>(kit.trees.size()))];
          budget.add(tree,
                     plot * moved({random.range(-4, 4), 0, random.range(-13, -9)}) * turned_y(random.angle()) *
                         scaled(glm::dvec3(random.range(0.6, 0.95))),
                     pick(greens, random));
        }
        if (random.chance(0.5))
          budget.add(kit.shrub, plot * moved({random.range(-3, 3), 0, 6.2}), pick(greens, random));
        if (random.chance(0.35))
          budget.add(kit.cars[random.index(2)],
                     polar(radius + side * 2.3, angle) * moved({0, 0.05, 0}) * turned_y(side > 0 ? pi / 2 : -pi / 2),
                     color(std::array{0xB23B32u, 0x2F5D8Cu, 0xE2E0DAu, 0x6F8F5Fu}[random.index(4)]));
      }
      angle += (half + 1.5) / std::min(line, front);
    }
    const int lamps = static_cast<int>(2 * pi * radius / 32);
    for (int k = 0; k < lamps; ++k)
      if (!on_spoke(radius, 2 * pi * k / lamps, 5))
        budget.add(kit.lamp,
                   polar(radius + side * (0.5 * ring_width + 0.6), 2 * pi * k / lamps) * turned_y(side > 0 ? pi : 0));
  }
}

/// Avenues along the roads that leave, and clumps of wood in the fields, until the triangles are spent.
void add_country(Budget& budget, const Kit& kit, Random& random) {
  const auto plant = [&](const glm::dmat4& where) {
    budget.add(kit.woods[random.index(static_cast<uint32_t>(kit.woods.size()))],
               where * turned_y(random.angle()) * scaled(glm::dvec3(random.range(0.8, 1.2))), pick(greens, random));
  };
  for (int k = 0; k < spokes; ++k)
    for (double r = 168; r < 380; r += 17)
      for (const double z : {-5.5, 5.5}) plant(turned_y(-2 * pi * k / spokes - 0.2) * moved({r, 0, z}));
  while (!budget.nearly_spent()) {
    const double r = random.range(185, 390), a = random.angle();
    for (int i = 0; i < 12; ++i) {
      const double away = 14 * std::sqrt(random.unit()), turn = random.angle();
      const glm::dvec2 at(r * std::cos(a) + away * std::cos(turn), r * std::sin(a) + away * std::sin(turn));
      if (!on_spoke(glm::length(at), std::atan2(at.y, at.x), 6)) plant(moved({at.x, 0, at.y}));
    }
  }
}

}  // namespace

BuiltinScene town() {
  BuiltinScene entry;
  entry.name = "town";
  entry.help = "a market town with rings of houses, gardens and woods, 800 m across, 528k triangles (RTW)";
  entry.make = [](const BuiltinValues&) {
    Scene scene;
    scene.name = "town";
    Random random(528);
    add_roads(scene);
    const Kit kit = make_kit(scene, random);
    Budget budget(scene, total_triangles);
    add_square(scene, budget, kit, random);
    for (const double radius : rings) add_ring(budget, kit, radius, random);
    add_country(budget, kit, random);
    add_camera(scene, "main", {150, 62, 172}, {-8, 4, -6}, 45);
    add_camera(scene, "market", {19.5, 2.4, 14.5}, {-4, 5.5, -6}, 58);
    add_camera(scene, "street", {48.5, 1.9, 14}, {44, 3.2, 32}, 58);
    // From the hills over the roofs into a street.
    add_camera_path(scene, "main", 2,
                    {{{150, 62, 172}, {-8, 4, -6}},
                     {{112, 44, 128}, {0, 4, 0}},
                     {{76, 24, 84}, {30, 4, 30}},
                     {{52, 9, 52}, {45, 3.5, 24}},
                     {{46, 3, 36}, {46.5, 3, 10}},
                     {{47.5, 1.9, 24}, {47.5, 3, 0}}},
                    55);
    add_sun(scene, 140, 36);
    return scene;
  };
  return entry;
}

}  // namespace shadewright::builtin
