// No light leaks into filters: wherever a receiver in shadow may lie, outside of all bodies and moved towards the light
// by no more than a receiver's offset takes away, no voxel of any filter around it is visible that a body or surface
// shadows. From single crossings by their definition, not from the ranges that the bake is made of.
#include <gtest/gtest.h>

#include <random>

#include "direct.h"
#include "shadewright/voxel/bake.h"
#include "test_scenes.h"

namespace shadewright::voxel {
namespace {

using Crossings = std::vector<std::pair<int32_t, Crossing>>;

Crossings crossings_at(const SnappedCasters& casters, int32_t x, int32_t y) {
  Crossings found;
  const int64_t px = texel_center(x), py = texel_center(y);
  for (const SnappedTriangle& triangle : casters.triangles)
    if (covers(triangle, px, py)) found.emplace_back(int32_t(exact_height(triangle, px, py)), triangle.crossing);
  std::ranges::sort(found, {}, &std::pair<int32_t, Crossing>::first);
  return found;
}

/// Ranges of depths, end excluded, in which a receiver in shadow may lie above a texel.
std::vector<std::pair<int32_t, int32_t>> receivers(const Crossings& crossings, bool static_receivers, int32_t depth) {
  std::vector<std::pair<int32_t, int32_t>> free;
  int inside = 0;
  for (size_t i = 0; i < crossings.size(); ++i) {
    inside += int(crossings[i].second);
    const int32_t next = i + 1 < crossings.size() ? crossings[i + 1].first : depth;
    if (inside == 0 && next != crossings[i].first) free.emplace_back(crossings[i].first, next);
  }
  if (!static_receivers) return free;
  std::vector<std::pair<int32_t, int32_t>> surfaces;
  for (size_t i = 1; i < crossings.size(); ++i)
    if (!free.empty() && crossings[i].first >= free.front().first)
      surfaces.emplace_back(crossings[i].first, crossings[i].first + 1);
  return surfaces;
}

struct Case {
  uint32_t max_filter;
  bool static_receivers;
  ClosedMode closed;
  bool soup;
};

class Guard : public testing::TestWithParam<Case> {};

/// Visible voxels that ought not to be, of filters up to `filter`.
uint64_t leaks(const Scene& scene, const Light& light, const BakeOptions& options, uint32_t filter) {
  const VoxelShadow shadow = bake(scene, light, options).shadow;
  const LightGrid& grid = shadow.light();
  const Casters casters = gather_casters(scene);
  const SnappedCasters snapped = snap(casters, find_topology(casters, scene, options.closed), grid);
  const int32_t size = int32_t(grid.size()), depth = int32_t(grid.depth()), reach = int32_t(filter / 2),
                margin = filter_margin(grid, filter);
  std::mt19937 random(3);
  uint64_t leaks = 0;
  for (int sample = 0; sample < 60; ++sample) {
    const glm::ivec3& corner = snapped.triangles[random() % snapped.triangles.size()].corners[random() % 3];
    const int32_t x = corner.x / kSubVoxels + int32_t(random() % 5) - 2,
                  y = corner.y / kSubVoxels + int32_t(random() % 5) - 2;
    if (x < 0 || y < 0 || x >= size || y >= size) continue;
    std::vector<int32_t> depths;
    for (const auto& [from, to] : receivers(crossings_at(snapped, x, y), options.static_receivers, depth))
      for (const int32_t z : {from, (from + to) / 2, to - 1})
        for (const int32_t towards_light : {0, 1, margin / 2, margin - 1, margin})
          // A receiver on a surface is moved off it.
          if (towards_light > 0 || !options.static_receivers) depths.push_back(z - towards_light);
    for (int32_t dy = -reach; dy <= reach; ++dy)
      for (int32_t dx = -reach; dx <= reach; ++dx) {
        const Crossings crossings = crossings_at(snapped, x + dx, y + dy);
        if (crossings.empty()) continue;
        for (const int32_t z : depths)
          leaks += z >= crossings.front().first && shadow.visible({x + dx, y + dy, z}) && x + dx >= 0 && y + dy >= 0 &&
                   x + dx < size && y + dy < size && z >= 0;
      }
  }
  return leaks;
}

TEST_P(Guard, LetsNoFilterReadAVisibleVoxelInABody) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  Scene scene = random_bodies(random, 25);
  if (GetParam().soup) add_mesh(scene, soup(random, 100, 0.7f));
  Light light;
  light.direction = glm::normalize(glm::dvec3(unit(random), -1.2 + unit(random), unit(random)));
  BakeOptions options;
  options.resolution = 256;
  options.max_filter = GetParam().max_filter;
  options.static_receivers = GetParam().static_receivers;
  options.closed = GetParam().closed;
  EXPECT_EQ(leaks(scene, light, options, options.max_filter), 0u);
}

INSTANTIATE_TEST_SUITE_P(Filters, Guard,
                         testing::Values(Case{3, false, ClosedMode::automatic, false},
                                         Case{9, false, ClosedMode::automatic, false},
                                         Case{9, false, ClosedMode::automatic, true},
                                         Case{17, false, ClosedMode::automatic, true},
                                         Case{9, false, ClosedMode::none, true}, Case{9, true, ClosedMode::none, true},
                                         Case{17, true, ClosedMode::automatic, true}));

TEST(GuardOptions, AFilterThatWasNotBakedWouldLeak) {
  std::mt19937 random(11);
  const Scene scene = random_bodies(random, 25);
  Light light;
  light.direction = glm::normalize(glm::dvec3(0.5, -1, 0.2));
  BakeOptions options;
  options.resolution = 256;
  options.max_filter = 1;
  EXPECT_GT(leaks(scene, light, options, 9), 0u);
}

}  // namespace
}  // namespace shadewright::voxel
