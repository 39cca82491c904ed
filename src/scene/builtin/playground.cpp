// A playground of thin bars, chains and ropes among trees (the playground of RTW): everything here is finer than a
// texel somewhere in the picture. Closed throughout.
#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/play_things.h"
#include "scene/builtin/random.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/stage.h"
#include "scene/builtin/street_things.h"
#include "scene/builtin/tree.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double half_size = 22;

void add_ground(Scene& scene) {
  place(scene, "lawn", slab({-half_size - 8, -1, -half_size - 8}, {half_size + 8, 0, half_size + 8}, 0.05),
        color(0x86A05C));
  // Fall surfaces: shallow discs and slabs that stand a few centimetres above the lawn.
  place(scene, "sand", transformed(cylinder(5.2, 0.34, 64), moved({-9, -0.3, -7})), color(0xD9C08A));
  place(scene, "sand", slab({2, -0.3, -13}, {15, 0.04, -3.5}, 0.02), color(0xD9C08A));
  place(scene, "rubber", transformed(cylinder(5.4, 0.33, 64), moved({-8, -0.3, 7.5})), color(0xB4644E));
  place(scene, "path", slab({-1.3, -0.3, -half_size - 7}, {1.3, 0.05, half_size + 7}, 0.02), color(0xC2B79F));
}

void add_fence(Scene& scene) {
  const Prop panel = railing(scene, 4.4);
  for (int side = 0; side < 4; ++side) {
    for (int k = 0; k < 10; ++k) {
      const double x = 4.4 * (k - 4.5);
      if (side % 2 == 0 && (k == 4 || k == 5)) continue;  // gates over the path
      place(scene, panel, turned_y(side * pi / 2) * moved({x, 0, half_size + 0.2}));
    }
  }
}

void add_trees(Scene& scene, Random& random) {
  constexpr std::array<uint32_t, 4> greens = {0x6F9A45, 0x5C8A3C, 0x86A84E, 0x9AA64A};
  std::vector<Prop> kinds;
  for (int k = 0; k < 4; ++k) {
    TreeShape shape;
    shape.height = random.range(7, 9.5);
    shape.spread = 0.33 * shape.height;
    shape.crown = Crown::leaves;
    shape.leaf_count = 9600;
    shape.leaf_size = 0.21;
    kinds.push_back(k == 3 ? conifer(scene, shape, random) : broadleaf_tree(scene, shape, random));
  }
  const glm::dvec2 spots[] = {{-17, -16},  {-16, 2}, {-18, 16}, {-3.8, 18},  {20, -6},  {18, 3},
                              {18.5, -17}, {5, -19}, {-6, -19}, {-15, -2.5}, {4.6, 3.4}};
  int k = 0;
  for (const glm::dvec2& at : spots)
    place(scene, kinds[static_cast<size_t>(k++ % 4)],
          moved({at.x, 0, at.y}) * turned_y(random.angle()) * scaled(glm::dvec3(random.range(0.85, 1.1))),
          color(greens[random.index(4)]));
}

}  // namespace

BuiltinScene playground() {
  BuiltinScene entry;
  entry.name = "playground";
  entry.help = "climbing frames, swings on chains, rope nets and trees, 712k triangles (RTW)";
  entry.make = [](const BuiltinValues&) {
    Scene scene;
    scene.name = "playground";
    Random random(712);
    add_ground(scene);
    add_fence(scene);
    add_trees(scene, random);

    const Prop swing = swings(scene), cube = climbing_cube(scene, 7, 5, 5), dome = climbing_dome(scene, 2.1),
               pyramid = rope_pyramid(scene);
    const Prop chute = slide(scene), plank = seesaw(scene), spinner = roundabout(scene), seat = bench(scene, 3),
               basket = bin(scene, 3), lamp = street_lamp(scene, 3);
    place(scene, pyramid, moved({-9, 0.03, -7}));
    place(scene, swing, moved({5.6, 0.03, -10.2}) * turned_y(0.1));
    place(scene, swing, moved({11.6, 0.03, -10.4}) * turned_y(-0.06), color(0xB4553F));
    place(scene, cube, moved({6, 0.03, -6}) * turned_y(0.0));
    place(scene, dome, moved({-8, 0.02, 7.5}));
    place(scene, chute, moved({9, 0, 4}) * turned_y(0.5));
    place(scene, plank, moved({4, 0, 8.5}) * turned_y(0.3));
    place(scene, plank, moved({4.8, 0, 11.2}) * turned_y(0.2), color(0x3F7CAC));
    place(scene, spinner, moved({12.5, 0, -0.8}));
    for (int k = 0; k < 5; ++k) {
      place(scene, seat, moved({k % 2 ? 2.2 : -2.2, 0, -16 + 7.5 * k}) * turned_y(k % 2 ? -pi / 2 : pi / 2));
      place(scene, lamp, moved({k % 2 ? -1.7 : 1.7, 0, -18 + 8.5 * k}) * turned_y(k % 2 ? 0 : pi));
    }
    for (const double z : {-11.5, 5.0, 14.0}) place(scene, basket, moved({1.8, 0, z}));

    add_camera(scene, "main", {15, 4.6, 17}, {-0.5, 1.2, -3}, 52);
    add_camera(scene, "bars", {8.9, 1.3, -1.9}, {5.2, 0.9, -7.2}, 50);
    add_camera(scene, "swings", {3.2, 1.2, -7.4}, {7.2, 0.9, -10.6}, 48);
    add_sun(scene, 158, 40);
    return scene;
  };
  return entry;
}

}  // namespace shadewright::builtin
