// Trees of single leaves beside coarse things (RMSM, figure 16): what needs the finest shadow map level next to what
// does not. Leaves are sheets of two triangles, so this scene is not closed.
#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/house.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/random.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/sweep.h"
#include "scene/builtin/shapes/terrain.h"
#include "scene/builtin/stage.h"
#include "scene/builtin/street_things.h"
#include "scene/builtin/tree.h"

namespace shadewright::builtin {
namespace {

double meadow(double x, double z) {
  const double r = std::sqrt(x * x + z * z);
  return 0.9 * noise(x / 19 + 4, z / 19, 48) * glm::smoothstep(7.0, 24.0, r);
}

void add_fence(Scene& scene, const glm::dvec3& from, const glm::dvec3& to) {
  Mesh wood;
  const int posts = static_cast<int>(glm::length(to - from) / 2);
  const auto at = [&](int k, double up) {
    const glm::dvec3 p = glm::mix(from, to, double(k) / posts);
    return glm::dvec3(p.x, meadow(p.x, p.z) + up, p.z);
  };
  for (int k = 0; k <= posts; ++k) append(wood, beam(at(k, -0.3), at(k, 1.15), 0.11, 0.11));
  for (int k = 0; k < posts; ++k)
    for (const double up : {0.45, 0.9}) append(wood, beam(at(k, up), at(k + 1, up + 0.02), 0.05, 0.12));
  place(scene, "fence", std::move(wood), color(0x9A7B58));
}

}  // namespace

BuiltinScene trees() {
  BuiltinScene entry;
  entry.name = "trees";
  entry.help = "trees of single leaves and coarse objects on a meadow, 48k triangles (RMSM fig. 16)";
  entry.make = [](const BuiltinValues&) {
    Scene scene;
    scene.name = "trees";
    Random random(16);
    place(scene, "meadow", terrain_solid({-32, -32}, {32, 32}, 44, 44, -3, meadow), color(0x93A566));
    constexpr std::array<uint32_t, 3> greens = {0x6F9A45, 0x86A84E, 0x5C8A3C};
    const auto grow = [&](const glm::dvec2& at, double height, uint32_t leaves, bool fir) {
      TreeShape shape;
      shape.height = height;
      shape.spread = fir ? 0.24 * height : 0.36 * height;
      shape.crown = Crown::sheets;
      shape.leaf_count = leaves;
      shape.leaf_size = fir ? 0.3 : 0.24;
      const Prop tree = fir ? conifer(scene, shape, random) : broadleaf_tree(scene, shape, random);
      place(scene, tree, moved({at.x, meadow(at.x, at.y), at.y}) * turned_y(random.angle()),
            fir ? color(0x3F6B4A) : color(greens[random.index(3)]));
    };
    grow({0, 0}, 9, 5200, false);
    grow({-8.5, -5}, 7.5, 3800, false);
    grow({9, -8}, 8.5, 3800, false);
    grow({-15, 6}, 7, 2700, false);
    grow({15, 5}, 10, 1900, true);
    grow({-3, -15}, 12, 1900, true);

    HouseShape cottage;
    cottage.width = 8.5;
    cottage.depth = 7.5;
    cottage.floors = 1;
    place(scene, house(scene, cottage, random), moved({8, meadow(8, -17) + 0.1, -17}) * turned_y(-0.3),
          color(0xDCC9A6));
    const Prop seat = bench(scene, 2);
    place(scene, seat, moved({1.8, meadow(1.8, 2.4), 2.4}) * turned_y(0.5));
    // Coarse things: a ball, blocks and a plank to walk along.
    place(scene, "ball", transformed(sphere(0.8, 24, 14), moved({-3.4, 0.79, 3.6})), color(0xC9573F));
    place(scene, "block",
          transformed(slab({-0.9, -0.1, -0.6}, {0.9, 0.8, 0.6}, 0.05),
                      moved({4.4, meadow(4.4, 0.6), 0.6}) * turned_y(0.7)),
          color(0xB9B4A8));
    place(scene, "block",
          transformed(slab({-0.5, -0.1, -0.5}, {0.5, 1.7, 0.5}, 0.05), moved({5.8, meadow(5.8, 2), 2}) * turned_y(0.2)),
          color(0xA9A498));
    place(scene, "plank", beam({4.2, 0.84 + meadow(4.4, 0.6), 0.5}, {6.4, 0.02 + meadow(6.4, -2.6), -2.6}, 0.35, 0.06),
          color(0xA98252));
    add_fence(scene, {-20, 0, 14}, {22, 0, 13});

    add_camera(scene, "wide", {13, 5.2, 21}, {-1, 2.6, -2}, 50);
    add_camera(scene, "under", {3.6, 1.6, 5.6}, {2.9, 0.5, -0.6}, 58);
    add_camera(scene, "crown", {4.4, 6.4, 5.6}, {0.2, 6.0, 0.2}, 34);
    add_sun(scene, 165, 47);
    return scene;
  };
  return entry;
}

}  // namespace shadewright::builtin
