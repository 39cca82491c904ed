// A city of closed things (the cities of RMSM and SPSM, CPVS's ClosedCity): blocks round a crossing, houses on the
// blocks' edges, courtyards, parks, streets with lamps and cars. It grows from the crossing outwards until its
// triangles are spent.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/budget.h"
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
constexpr double street = 11, pavement = 0.15, pavement_width = 3.4;

struct Kit {
  double block_x = 40, block_z = 36;  ///< a block's sides; metres
  std::vector<Prop> houses, trees, cars;
  double car_spacing = 11;
  std::vector<double> widths;  ///< of the houses
  Prop lamp, bench, bollard, bin, fountain;
};

Kit make_kit(Scene& scene, int detail, Random& random) {
  Kit kit;
  if (detail > 1) {
    kit.block_x = 62;
    kit.block_z = 46;
    kit.car_spacing = 5.6;
  }
  const std::array<double, 9> widths = {7.5, 8.5, 9.5, 10.5, 7.5, 11.5, 8.5, 9.5, 12.5};
  for (size_t k = 0; k < widths.size(); ++k) {
    HouseShape shape;
    shape.width = widths[k];
    shape.depth = random.range(9.2, 10.8);
    shape.floors = detail == 1 ? 2 + static_cast<int>(k % 2) : 2 + static_cast<int>(k % 3) + (k >= 5 ? 1 : 0);
    shape.roof = k % 4 == 3 || shape.floors >= 5 ? Roof::flat : (k % 4 == 1 ? Roof::hip : Roof::gable);
    shape.detail = detail;
    kit.houses.push_back(house(scene, shape, random));
    kit.widths.push_back(shape.width);
  }
  for (int k = 0; k < 4; ++k) {
    TreeShape shape;
    shape.height = random.range(6.5, 9.5);
    shape.spread = 0.3 * shape.height;
    shape.crown = detail == 1 ? Crown::lumps : Crown::leaves;
    shape.leaf_count = detail == 2 ? 500 : 900;
    shape.leaf_size = detail == 2 ? 0.5 : 0.36;
    kit.trees.push_back(k == 3 ? conifer(scene, shape, random) : broadleaf_tree(scene, shape, random));
  }
  for (int k = 0; k < 3; ++k) kit.cars.push_back(car(scene, detail, random));
  kit.lamp = street_lamp(scene, detail);
  kit.bench = bench(scene, detail);
  kit.bollard = bollard(scene, detail);
  kit.bin = bin(scene, detail);
  kit.fountain = fountain(scene, detail);
  return kit;
}

constexpr std::array<uint32_t, 9> plasters = {0xD9C7A3, 0xC98F6B, 0xE3DCCB, 0xA9B5A0, 0xD8B98C,
                                              0xB7685A, 0xC9B7C0, 0x9FB0BD, 0xE0C98F};
constexpr std::array<uint32_t, 7> paints = {0xB23B32, 0x2F5D8C, 0xE2E0DA, 0x3C4043, 0x6F8F5F, 0xD9A441, 0x8C8F94};
constexpr std::array<uint32_t, 5> greens = {0x6F9A45, 0x5C8A3C, 0x86A84E, 0x9AA64A, 0x577F4A};

template <size_t N>
glm::vec3 pick(const std::array<uint32_t, N>& palette, Random& random) {
  return shade(color(palette[random.index(N)]), random.range(0.9, 1.08));
}

/// A row of houses along x, centred, fronts facing +Z at z = 0.
void add_row(Budget& budget, const Kit& kit, const glm::dmat4& row, double length, Random& random) {
  double x = -0.5 * length;
  while (x < 0.5 * length - 7.5) {
    const size_t k = random.index(static_cast<uint32_t>(kit.houses.size()));
    if (x + kit.widths[k] > 0.5 * length) {
      x += 0.8;
      continue;
    }
    // Neighbours differ in how far they stand back, so that no two walls share a plane.
    const double back = random.range(0.0, 0.5);
    budget.add(kit.houses[k], row * moved({x + 0.5 * kit.widths[k], 0, -5.4 - back}), pick(plasters, random));
    x += kit.widths[k] + (random.chance(0.25) ? random.range(2.0, 3.5) : 0.12);
  }
}

void add_green(Budget& budget, const Kit& kit, const glm::dmat4& where, Random& random) {
  const Prop& tree = kit.trees[random.index(static_cast<uint32_t>(kit.trees.size()))];
  budget.add(tree, where * turned_y(random.angle()) * scaled(glm::dvec3(random.range(0.75, 1.1))),
             pick(greens, random));
}

/// The pavement's lamps, trees, bins and bollards, and the cars along the kerb, on the block's side towards +Z.
void add_kerb(Budget& budget, const Kit& kit, const glm::dmat4& edge, double length, Random& random) {
  const int lamps = static_cast<int>(length / 20);
  for (int k = 0; k < lamps; ++k)
    budget.add(kit.lamp, edge * moved({length * ((k + 0.5) / lamps - 0.5), pavement, -0.5}) * turned_y(-pi / 2));
  for (int k = 0; k < lamps - 1; ++k)
    add_green(budget, kit,
              edge * moved({length * ((k + 1.0) / lamps - 0.5), pavement, -0.9}) * scaled(glm::dvec3(0.72)), random);
  for (const double side : {-1.0, 1.0})
    for (int k = 0; k < 2; ++k)
      budget.add(kit.bollard, edge * moved({side * (0.5 * length - 1.0 - 1.5 * k), pavement, -0.35}));
  budget.add(kit.bin, edge * moved({0.5 * length - 6, pavement, -0.6}));
  for (double x = -0.5 * length + 5; x < 0.5 * length - 5; x += kit.car_spacing * random.range(1, 2))
    budget.add(kit.cars[random.index(static_cast<uint32_t>(kit.cars.size()))],
               edge * moved({x, 0, 1.25}) * turned_y(random.chance(0.8) ? 0 : pi), pick(paints, random));
}

void add_park(Budget& budget, const Kit& kit, const glm::dmat4& lawn, Random& random) {
  budget.add(kit.fountain, lawn);
  for (int k = 0; k < 8; ++k) {
    const double a = 2 * pi * k / 8;
    budget.add(kit.bench, lawn * turned_y(a) * moved({0, 0, -5}));
  }
  for (int k = 0; k < 26; ++k) {
    const double x = random.range(-0.42, 0.42) * kit.block_x, z = random.range(-0.4, 0.4) * kit.block_z;
    if (x * x + z * z > 60) add_green(budget, kit, lawn * moved({x, 0, z}), random);
  }
}

void add_block(Budget& budget, const Kit& kit, const Prop& pavement_slab, const Prop& lawn, const glm::dvec3& center,
               bool park, Random& random) {
  const glm::dmat4 at = moved(center);
  if (!budget.add(pavement_slab, at)) return;
  budget.add(lawn, at, park ? color(0x88A85F) : color(0x94A873));
  const std::array<glm::dmat4, 4> edges = {at * moved({0, 0, 0.5 * kit.block_z}),
                                           at * turned_y(pi) * moved({0, 0, 0.5 * kit.block_z}),
                                           at * turned_y(pi / 2) * moved({0, 0, 0.5 * kit.block_x}),
                                           at * turned_y(-pi / 2) * moved({0, 0, 0.5 * kit.block_x})};
  const glm::dmat4 on_lawn = at * moved({0, pavement + 0.05, 0});
  if (park) {
    add_park(budget, kit, on_lawn, random);
  } else {
    for (size_t k = 0; k < 4; ++k) {
      const double length = k < 2 ? kit.block_x - 2 * pavement_width : kit.block_z - 2 * pavement_width - 23;
      add_row(budget, kit, edges[k] * moved({0, pavement, -pavement_width}), length, random);
    }
    for (int k = 0; k < 5; ++k)
      add_green(budget, kit, on_lawn * moved({random.range(-15, 15), 0, random.range(-5, 5)}), random);
  }
  for (size_t k = 0; k < 4; ++k) add_kerb(budget, kit, edges[k], k < 2 ? kit.block_x : kit.block_z, random);
}

/// Centres of blocks, nearest to the crossing at the origin first.
std::vector<glm::ivec2> blocks_outwards(const Kit& kit, int reach) {
  std::vector<glm::ivec2> cells;
  // Of equally near blocks those towards the overview camera come first: the last one may stay half empty.
  for (int j = reach - 1; j >= -reach; --j)
    for (int i = reach - 1; i >= -reach; --i) cells.emplace_back(i, j);
  const auto distance = [&](const glm::ivec2& c) {
    const double x = (c.x + 0.5) * (kit.block_x + street), z = (c.y + 0.5) * (kit.block_z + street);
    return x * x + z * z;
  };
  std::stable_sort(cells.begin(), cells.end(), [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  return cells;
}

Scene make_city(size_t triangles) {
  Scene scene;
  scene.name = "city";
  Random random(58);
  const int detail = triangles < 150000 ? 1 : (triangles < 1000000 ? 2 : 3);
  const Kit kit = make_kit(scene, detail, random);

  Prop slab_prop, lawn;
  slab_prop.name = "pavement";
  add_part(scene, slab_prop,
           slab({-0.5 * kit.block_x, -0.3, -0.5 * kit.block_z}, {0.5 * kit.block_x, pavement, 0.5 * kit.block_z}, 0.03),
           color(0xB5AFA4));
  lawn.name = "lawn";
  const double inset = pavement_width + 0.4;
  add_part(scene, lawn,
           slab({-0.5 * kit.block_x + inset, -0.2, -0.5 * kit.block_z + inset},
                {0.5 * kit.block_x - inset, pavement + 0.05, 0.5 * kit.block_z - inset}, 0.02),
           color(0x94A873), true);
  Prop dash;
  dash.name = "road marking";
  add_part(scene, dash, slab({-1.2, -0.05, -0.07}, {1.2, 0.015, 0.07}, 0.004), color(0xE8E6DF));

  Budget budget(scene, triangles - 20);  // 20 for the ground
  double reach_x = 0, reach_z = 0;
  int count = 0;
  for (const glm::ivec2& cell : blocks_outwards(kit, 14)) {
    if (budget.nearly_spent()) break;
    const glm::dvec3 center((cell.x + 0.5) * (kit.block_x + street), 0, (cell.y + 0.5) * (kit.block_z + street));
    const bool park = count % 7 == 4;
    add_block(budget, kit, slab_prop, lawn, center, park, random);
    // Dashes along the two streets at the block's sides of +X and +Z.
    for (int k = 0; k < 10; ++k) {
      budget.add(dash,
                 moved({center.x + kit.block_x * ((k + 0.5) / 10 - 0.5), 0, center.z + 0.5 * (kit.block_z + street)}));
      if (k < 8)
        budget.add(dash,
                   moved({center.x + 0.5 * (kit.block_x + street), 0, center.z + kit.block_z * ((k + 0.5) / 8 - 0.5)}) *
                       turned_y(pi / 2));
    }
    reach_x = std::max(reach_x, std::abs(center.x) + 0.5 * kit.block_x + 1.5 * street);
    reach_z = std::max(reach_z, std::abs(center.z) + 0.5 * kit.block_z + 1.5 * street);
    ++count;
  }
  place(scene, "asphalt", slab({-reach_x, -1.5, -reach_z}, {reach_x, 0, reach_z}, 0.05), color(0x6B6C6E));

  add_camera(scene, "overview", {0.62 * reach_x, 20 + 0.42 * reach_z, 0.95 * reach_z},
             {-0.04 * reach_x, 2, -0.06 * reach_z}, 45);
  add_camera(scene, "street", {1.4, 1.7, 34}, {-1.6, 3.2, -20}, 58);
  // From over the roofs down into the street and along it.
  add_camera_path(scene, "main", 1.5,
                  {{{0.5 * reach_x, 16 + 0.3 * reach_z, 0.8 * reach_z}, {0, 2, 0}},
                   {{0.25 * reach_x, 12 + 0.18 * reach_z, 0.65 * reach_z}, {0, 2, 0}},
                   {{3, 14, 52}, {-1, 3, 10}},
                   {{1.4, 3, 36}, {-1.2, 3, -4}},
                   {{0.4, 1.7, 24}, {-1.4, 3.2, -16}},
                   {{-0.6, 1.9, 10}, {-0.8, 3.4, -30}}},
                  55);
  add_sun(scene, 128, 40);
  return scene;
}

}  // namespace

BuiltinScene city() {
  BuiltinScene entry;
  entry.name = "city";
  entry.help = "houses, streets, lamps, cars and trees, every one closed (RMSM 58k, SPSM 2.3M, CPVS ClosedCity 613k)";
  entry.parameters = {{"triangles", "how many triangles the city may spend", 58000, 20000, 2500000}};
  entry.make = [](const BuiltinValues& values) { return make_city(static_cast<size_t>(values.at("triangles"))); };
  return entry;
}

}  // namespace shadewright::builtin
