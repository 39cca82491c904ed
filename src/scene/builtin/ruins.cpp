// A ruined town of open sheets and walls of one side (CPVS's Necropolis and Epic Citadel): nothing here is closed. It
// grows from the temple in the middle outwards until its triangles are spent.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/budget.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/ruin_parts.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/terrain.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double plot = 20;  // metres: the side of the square that each ensemble stands on

struct Kit {
  std::vector<Prop> columns, stumps, drums, walls, sheets, tombs, stones;
  Prop arches, aqueduct, dome, temple_steps, small_steps, weeds;
};

Kit make_kit(Scene& scene, double detail, Random& random) {
  const RuinPartSize size{detail};
  Kit kit;
  for (int k = 0; k < 2; ++k) kit.columns.push_back(ruin_column(scene, size, 0, random));
  for (int k = 0; k < 4; ++k) kit.stumps.push_back(ruin_column(scene, size, random.range(0.25, 0.85), random));
  for (int k = 0; k < 3; ++k) kit.drums.push_back(ruin_drum(scene, size, random));
  for (int k = 0; k < 3; ++k)
    kit.walls.push_back(ruin_wall(scene, size, random.range(7, 11), random.range(3.5, 7), false, random));
  for (int k = 0; k < 3; ++k)
    kit.sheets.push_back(ruin_wall(scene, size, random.range(5, 9), random.range(3, 5), true, random));
  for (int k = 0; k < 5; ++k) kit.tombs.push_back(ruin_tomb(scene, size, random));
  for (int k = 0; k < 6; ++k) kit.stones.push_back(ruin_stone(scene, size, random));
  kit.arches = ruin_arches(scene, size, 3, 5.2, random);
  kit.aqueduct = ruin_arches(scene, size, 4, 8.5, random);
  kit.dome = ruin_dome(scene, size, random);
  kit.temple_steps = ruin_steps(scene, 8.5, 12, 4);
  kit.small_steps = ruin_steps(scene, 6, 6, 3);
  kit.weeds = ruin_weeds(scene, 260, 2.2, random);
  return kit;
}

double ground_height(double x, double z) {
  return 0.5 * fractal_noise(x / 38, z / 38, 4, 0.45, 90);
}

/// Places ensembles; each part stands on the ground where it is put.
class Town {
 public:
  Town(Budget& budget, const Kit& kit, Random& random) : budget_(budget), kit_(kit), random_(random) {}

  /// `part` at (x, z) of the plot at `center`, turned, `lift` metres above the ground.
  void put(const Prop& part, const glm::dvec2& center, double x, double z, double turn, double lift = 0) {
    const double wx = center.x + x, wz = center.y + z;
    const double tone = random_.range(0.85, 1.08);
    budget_.add(part, moved({wx, ground_height(wx, wz) + lift, wz}) * turned_y(turn), tint(part, tone));
  }
  const Prop& any(const std::vector<Prop>& props) { return props[random_.index(static_cast<uint32_t>(props.size()))]; }

  void litter(const glm::dvec2& c, int stones, int weeds) {
    for (int k = 0; k < stones; ++k) put(any(kit_.stones), c, spread(), spread(), random_.angle());
    for (int k = 0; k < weeds; ++k) put(kit_.weeds, c, spread(), spread(), random_.angle());
  }
  void temple(const glm::dvec2& c) {
    put(kit_.temple_steps, c, 0, 0, 0, 0.1);
    for (int k = 0; k < 7; ++k)
      for (const double side : {-1.0, 1.0})
        put(random_.chance(0.65) ? any(kit_.columns) : any(kit_.stumps), c, 6.2 * side, 9.6 * (k / 3.0 - 1),
            random_.angle(), 0.75);
    for (const double x : {-3.1, 0.0, 3.1})
      for (const double side : {-1.0, 1.0})
        put(random_.chance(0.6) ? any(kit_.columns) : any(kit_.stumps), c, x, 9.6 * side, random_.angle(), 0.75);
    litter(c, 8, 4);
  }
  void colonnade(const glm::dvec2& c) {
    for (int k = 0; k < 6; ++k)
      for (const double side : {-1.0, 1.0})
        put(random_.chance(0.35) ? any(kit_.columns) : any(kit_.stumps), c, 3.2 * (k - 2.5), 4 * side, random_.angle());
    for (int k = 0; k < 4; ++k) put(any(kit_.drums), c, spread(), spread(), random_.angle());
    litter(c, 10, 6);
  }
  void tombs(const glm::dvec2& c) {
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 3; ++i)
        put(any(kit_.tombs), c, 6.2 * (i - 1), j ? 5 : -5, (j ? pi : 0) + random_.range(-0.12, 0.12));
    litter(c, 8, 8);
  }
  void house(const glm::dvec2& c) {
    put(any(kit_.walls), c, 0, 5, 0);
    put(any(kit_.walls), c, -5.2, 0, pi / 2);
    put(any(kit_.sheets), c, 5, -0.5, pi / 2);
    put(any(kit_.sheets), c, 0.5, -5.1, 0);
    put(any(kit_.stumps), c, 2, 1.5, random_.angle());
    litter(c, 14, 6);
  }
  void rotunda(const glm::dvec2& c) {
    put(kit_.small_steps, c, 0, 0, 0, 0.1);
    put(kit_.dome, c, 0, 0, random_.angle(), 0.6);
    litter(c, 8, 6);
  }
  void arcade(const glm::dvec2& c) {
    put(kit_.arches, c, 0, -5.5, 0);
    put(kit_.arches, c, 0, 5.5, pi);
    put(any(kit_.walls), c, -8.3, 0, pi / 2);
    litter(c, 8, 5);
  }
  /// Spans that meet end to end with those of the plots beside this one.
  void aqueduct(const glm::dvec2& c) {
    put(kit_.aqueduct, c, 0, 0, random_.chance(0.5) ? 0 : pi);
    litter(c, 12, 7);
  }

 private:
  double spread() { return random_.range(-0.46, 0.46) * plot; }
  glm::vec3 tint(const Prop& part, double tone) const { return shade(part.parts.front().albedo, tone); }

  Budget& budget_;
  const Kit& kit_;
  Random& random_;
};

std::vector<glm::ivec2> plots_outwards(int reach) {
  std::vector<glm::ivec2> cells;
  for (int j = -reach; j <= reach; ++j)
    for (int i = -reach; i <= reach; ++i) cells.emplace_back(i, j);
  std::stable_sort(cells.begin(), cells.end(),
                   [](const auto& a, const auto& b) { return a.x * a.x + a.y * a.y < b.x * b.x + b.y * b.y; });
  return cells;
}

Scene make_ruins(size_t triangles) {
  Scene scene;
  scene.name = "ruins";
  Random random(1204);
  const double detail = triangles < 800000 ? 0.85 : 1.25;
  const Kit kit = make_kit(scene, detail, random);
  // A fortieth of the triangles is the ground's.
  Budget budget(scene, triangles - triangles / 40);
  Town town(budget, kit, random);
  double reach = plot;
  for (const glm::ivec2& cell : plots_outwards(24)) {
    if (budget.nearly_spent()) break;
    const glm::dvec2 center = plot * glm::dvec2(cell);
    reach = std::max(reach, std::max(std::abs(center.x), std::abs(center.y)) + 0.7 * plot);
    if (cell == glm::ivec2(0)) {
      town.temple(center);
    } else if (cell.y == -1) {
      town.aqueduct(center);
    } else {
      switch (random.index(5)) {
        case 0:
          town.colonnade(center);
          break;
        case 1:
          town.tombs(center);
          break;
        case 2:
          town.house(center);
          break;
        case 3:
          town.rotunda(center);
          break;
        default:
          town.arcade(center);
          break;
      }
    }
  }
  const uint32_t cells = static_cast<uint32_t>(std::sqrt(double(triangles) / 80));
  place(scene, "ground", terrain_sheet(glm::dvec2(-reach), glm::dvec2(reach), cells, cells, ground_height),
        color(0xB3A27C));
  add_camera(scene, "main", {13, 1.9 + ground_height(13, 19), 19}, {-3, 3.2, -4}, 58);
  add_camera(scene, "overview", {0.5 * reach, 0.42 * reach, 0.85 * reach}, {0, 0, -0.08 * reach}, 45);
  // On foot to the middle, then up and away.
  add_camera_path(scene, "main", 2,
                  {{{13, 1.9 + ground_height(13, 19), 19}, {-3, 3.2, -4}},
                   {{9, 2.2 + ground_height(9, 13), 13}, {-5, 3.4, -6}},
                   {{6, 4 + ground_height(6, 9), 9}, {-6, 3, -10}},
                   {{10, 14, 20}, {-4, 1, -8}},
                   {{0.25 * reach, 0.2 * reach, 0.4 * reach}, {0, 0, -0.05 * reach}},
                   {{0.5 * reach, 0.42 * reach, 0.85 * reach}, {0, 0, -0.08 * reach}}},
                  55);
  add_sun(scene, 14, 34);
  return scene;
}

}  // namespace

BuiltinScene ruins() {
  BuiltinScene entry;
  entry.name = "ruins";
  entry.help =
      "columns, arches, tombs and broken walls of open sheets, not closed (CPVS Necropolis 2.1M, Epic Citadel 373k)";
  entry.parameters = {{"triangles", "how many triangles the town may spend", 2100000, 100000, 4000000}};
  entry.make = [](const BuiltinValues& values) { return make_ruins(static_cast<size_t>(values.at("triangles"))); };
  return entry;
}

}  // namespace shadewright::builtin
