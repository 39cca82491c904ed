// A meadow and woods of some 320 different plants in tens of thousands of instances, and cows (PSM, figure 10): far
// more triangles than could be stored once each. Plants are sheets, so the scene is not closed.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "scene/builtin/noise.h"
#include "scene/builtin/plants.h"
#include "scene/builtin/random.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/terrain.h"
#include "scene/builtin/stage.h"
#include "scene/builtin/tree.h"

namespace shadewright::builtin {
namespace {

constexpr double full_triangles = 22e6, full_half_size = 150;  // metres
constexpr uint32_t terrain_cells = 180;

double ground(double x, double z) {
  const double r = std::sqrt(x * x + z * z);
  return 9 * fractal_noise(x / 140 + 0.3, z / 140, 5, 0.42, 20) * glm::smoothstep(10.0, 60.0, r);
}

/// 0 in the open, 1 deep in the woods; the meadow about the origin is always open.
double wood_at(double x, double z) {
  const double r = std::sqrt(x * x + z * z);
  return glm::smoothstep(-0.1, 0.35, fractal_noise(x / 60 + 7, z / 60, 3, 0.5, 33)) * glm::smoothstep(16.0, 30.0, r);
}

/// One layer of the vegetation: kinds of plant, their share of all triangles, and how likely they grow at a place.
struct Layer {
  std::vector<Prop> kinds;
  double share = 0;
  double smallest = 0.8, largest = 1.2;
  std::function<double(double wood)> likely;
};

std::vector<Prop> make_kinds(Scene& scene, int count, Random& random, Prop (*make)(Scene&, Random&)) {
  std::vector<Prop> kinds;
  for (int k = 0; k < count; ++k) kinds.push_back(make(scene, random));
  return kinds;
}

Prop some_tree(Scene& scene, Random& random) {
  TreeShape shape;
  shape.height = random.range(5, 13);
  shape.spread = shape.height * random.range(0.26, 0.4);
  shape.crown = Crown::sheets;
  shape.leaf_count = 900 + random.index(500);
  shape.leaf_size = random.range(0.24, 0.42);
  return broadleaf_tree(scene, shape, random);
}

Prop some_fir(Scene& scene, Random& random) {
  TreeShape shape;
  shape.height = random.range(7, 16);
  shape.spread = shape.height * random.range(0.18, 0.28);
  shape.crown = Crown::sheets;
  shape.leaf_count = 1200 + random.index(500);
  shape.leaf_size = random.range(0.3, 0.45);
  return conifer(scene, shape, random);
}

std::vector<Layer> make_layers(Scene& scene, Random& random) {
  std::vector<Layer> layers;
  const auto open = [](double wood) { return 1 - 0.75 * wood; };
  const auto under_trees = [](double wood) { return 0.03 + wood; };
  const auto edges = [](double wood) { return 0.1 + 3.4 * wood * (1 - wood); };
  layers.push_back(
      {make_kinds(scene, 30, random, some_tree), 0.25, 0.7, 1.15, [](double wood) { return wood * wood; }});
  layers.push_back({make_kinds(scene, 20, random, some_fir), 0.15, 0.6, 1.15, [](double wood) { return wood * wood; }});
  layers.push_back({make_kinds(scene, 60, random, shrub), 0.16, 0.7, 1.3, edges});
  layers.push_back({make_kinds(scene, 50, random, fern), 0.14, 0.7, 1.3, under_trees});
  layers.push_back({make_kinds(scene, 70, random, flower), 0.08, 0.8, 1.3, open});
  layers.push_back({make_kinds(scene, 80, random, grass_tuft), 0.215, 0.8, 1.4, open});
  layers.push_back({make_kinds(scene, 10, random, mushroom), 0.005, 0.8, 1.4, under_trees});
  return layers;
}

/// Sows until the layer's share of `triangles` is spent.
void sow(Scene& scene, const Layer& layer, double triangles, double half_size, Random& random) {
  double left = layer.share * triangles;
  while (left > 0) {
    const double x = random.range(-half_size, half_size), z = random.range(-half_size, half_size);
    if (random.unit() > layer.likely(wood_at(x, z))) continue;
    const Prop& plant = layer.kinds[random.index(static_cast<uint32_t>(layer.kinds.size()))];
    const glm::vec3 own = plant.parts.back().dyed ? plant.parts.back().albedo : plant.parts.front().albedo;
    // Greens drift from place to place, as soils do.
    const double dry = 0.5 + 0.5 * noise(x / 25, z / 25, 4);
    const glm::vec3 dye =
        shade(glm::mix(own, color(0xA8A04A), static_cast<float>(0.35 * dry)), random.range(0.85, 1.1));
    place(scene, plant,
          moved({x, ground(x, z), z}) * turned_y(random.angle()) *
              scaled(glm::dvec3(random.range(layer.smallest, layer.largest))),
          dye);
    left -= static_cast<double>(triangle_count(scene, plant));
  }
}

}  // namespace

BuiltinScene ecosystem() {
  BuiltinScene entry;
  entry.name = "ecosystem";
  entry.help = "320 kinds of plants in 22 million triangles by instancing, and cows (PSM fig. 10)";
  entry.parameters = {{"triangles", "how many triangles with all instances counted; the land grows with them",
                       full_triangles, 1e6, 60e6}};
  entry.make = [](const BuiltinValues& values) {
    Scene scene;
    scene.name = "ecosystem";
    Random random(320);
    const double triangles = values.at("triangles"), half_size = full_half_size * std::sqrt(triangles / full_triangles);
    place(
        scene, "ground",
        terrain_solid(glm::dvec2(-half_size - 3), glm::dvec2(half_size + 3), terrain_cells, terrain_cells, -25, ground),
        color(0x8A8550));
    const double sown = triangles - 2.0 * terrain_cells * terrain_cells;
    for (const Layer& layer : make_layers(scene, random)) sow(scene, layer, sown, half_size, random);

    constexpr std::array<uint32_t, 4> hides = {0x8A5A3C, 0xD9CDBA, 0x4A3A32, 0xA87850};
    const std::array<glm::dvec3, 6> herd = {glm::dvec3(3, 0.4, 1), {-4, 2.2, -3}, {7, -0.6, -6},
                                            {-1, 1.4, -9},         {10, 2.8, 3},  {-8, -0.3, 4}};  // x, turn, z
    for (size_t k = 0; k < herd.size(); ++k)
      place(scene, cow(scene, random),
            moved({herd[k].x, ground(herd[k].x, herd[k].z), herd[k].z}) * turned_y(herd[k].y), color(hides[k % 4]));

    add_camera(scene, "main", {9, ground(9, 15) + 2.2, 15}, {-1, 1.2, -6}, 52);
    add_camera(scene, "overview", {0.55 * half_size, 0.4 * half_size, 0.8 * half_size},
               {-0.05 * half_size, 0, -0.1 * half_size}, 45);
    add_sun(scene, 155, 38);
    return scene;
  };
  return entry;
}

}  // namespace shadewright::builtin
