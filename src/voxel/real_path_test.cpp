// The real path against direct depth comparison: no disagreement where a voxel is defined, on soups, bodies, edge-on
// faces.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>

#include "direct.h"
#include "light_fit.h"
#include "shadewright/voxel/bake.h"
#include "test_scenes.h"

namespace shadewright::voxel {
namespace {

/// Checks every texel's voxels next to where its ranges begin and end, and some between.
void expect_agreement(const Scene& scene, const Light& light, const BakeOptions& options) {
  const BakeResult baked = bake(scene, light, options);
  const LightGrid& grid = baked.shadow.light();
  const Casters casters = gather_casters(scene);
  const Topology topology = find_topology(casters, scene, options.closed);
  const SnappedCasters snapped = snap(casters, topology, grid);
  const DirectDepths direct(snapped, grid,
                            {options.static_receivers, options.max_filter, filter_margin(grid, options.max_filter)});
  std::mt19937 random(1);
  const int32_t size = int32_t(grid.size()), depth = int32_t(grid.depth());
  uint64_t wrong = 0;
  for (int32_t y0 = 0; y0 < size; y0 += 64)
    for (int32_t x0 = 0; x0 < size; x0 += 64) {
      const std::vector<TexelRange> ranges = direct.ranges(x0, y0, 64, 64);
      for (int32_t t = 0; t < 64 * 64; ++t) {
        const int32_t first = ranges[size_t(t)].first, limit = ranges[size_t(t)].limit;
        const auto check = [&](int32_t z, bool visible) {
          wrong += baked.shadow.visible({x0 + t % 64, y0 + t / 64, z}) != visible;
        };
        if (first > 0) check(first - 1, true), check(int32_t(random() % uint32_t(first)), true);
        if (limit < depth) check(limit, false), check(limit + int32_t(random() % uint32_t(depth - limit)), false);
      }
    }
  EXPECT_EQ(wrong, 0u);
}

Light light_from(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Light light;
  light.direction = glm::normalize(glm::dvec3(unit(random), -1.2 + unit(random), unit(random)));
  return light;
}

Light straight_down() {
  Light light;
  light.direction = {0, -1, 0};
  return light;
}

Light spot() {
  Light light;
  light.kind = LightKind::spot;
  light.position = {2, 7, 1};
  light.direction = glm::normalize(glm::dvec3(-0.2, -1, 0.1));
  return light;
}

Light narrow_spot() {
  Light light = spot();
  light.outer_angle = 0.6;
  return light;
}

struct Case {
  uint32_t resolution, max_filter;
  bool static_receivers;
  ClosedMode closed;
};

class RealPath : public testing::TestWithParam<Case> {
 protected:
  BakeOptions options() const {
    BakeOptions options;
    options.resolution = GetParam().resolution;
    options.max_filter = GetParam().max_filter;
    options.static_receivers = GetParam().static_receivers;
    options.closed = GetParam().closed;
    return options;
  }
};

TEST_P(RealPath, AgreesOnBodies) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  expect_agreement(random_bodies(random, 40), light_from(random), options());
}

TEST_P(RealPath, AgreesOnEdgeOnFaces) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  expect_agreement(random_bodies(random, 25), straight_down(), options());
}

TEST_P(RealPath, AgreesOnSoups) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  Scene scene;
  add_mesh(scene, soup(random, 300, 0.7f));
  expect_agreement(scene, light_from(random), options());
}

TEST_P(RealPath, AgreesOnBodiesAmongSoup) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  Scene scene = random_bodies(random, 20);
  add_mesh(scene, soup(random, 60, 0.5f));
  expect_agreement(scene, light_from(random), options());
}

TEST_P(RealPath, AgreesUnderASpot) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  expect_agreement(random_bodies(random, 30), narrow_spot(), options());
}

/// A sheet that reaches over the map's corner: what of it lies outside says nothing of the texels there.
TEST_P(RealPath, AgreesAtACornerOfASpot) {
  std::mt19937 random(56939385);
  expect_agreement(random_bodies(random, 30), narrow_spot(), options());
}

TEST_P(RealPath, AgreesInsideBounds) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  BakeOptions bounded = options();
  bounded.bounds = Box{{-1, -1.2, -0.5}, {0.5, 0.2, 1}};
  expect_agreement(random_bodies(random, 40), light_from(random), bounded);
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, RealPath,
    testing::Values(Case{64, 1, false, ClosedMode::automatic}, Case{256, 1, false, ClosedMode::automatic},
                    Case{256, 9, false, ClosedMode::automatic}, Case{256, 17, true, ClosedMode::automatic},
                    Case{256, 1, true, ClosedMode::none}, Case{256, 3, false, ClosedMode::none},
                    Case{256, 3, false, ClosedMode::all}, Case{512, 9, true, ClosedMode::automatic}),
    [](const auto& instance) {
      const Case& c = instance.param;
      return std::to_string(c.resolution) + "_filter" + std::to_string(c.max_filter) +
             (c.static_receivers ? "_static" : "") +
             (c.closed == ClosedMode::none  ? "_open"
              : c.closed == ClosedMode::all ? "_all"
                                            : "");
    });

TEST(RealPathOptions, AgreesAt1024WithThePaperRule) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const Scene scene = random_bodies(random, 60);
  const Light light = light_from(random);
  BakeOptions options;
  options.resolution = 1024;
  options.max_filter = 5;
  expect_agreement(scene, light, options);
  options.resolving = Resolving::paper;
  expect_agreement(scene, light, options);
  options.depth_voxels = 128;
  expect_agreement(scene, light, options);
}

TEST(RealPathOptions, StabbingIsNotLargerThanThePaperRule) {
  std::mt19937 random(5);
  const Scene scene = random_bodies(random, 60);
  const Light light = light_from(random);
  BakeOptions options;
  options.resolution = 1024;
  const uint64_t stabbed = bake(scene, light, options).shadow.dag_bytes();
  options.resolving = Resolving::paper;
  EXPECT_LT(stabbed, bake(scene, light, options).shadow.dag_bytes());
}

TEST(RealPathOptions, TheBytesDoNotDependOnTheThreads) {
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 4);  // also on machines with fewer cores
  std::mt19937 random(7);
  const Scene scene = random_bodies(random, 50);
  const Light light = light_from(random);
  BakeOptions options;
  options.resolution = 1024;
  options.pyramid = true;
  options.threads = 1;
  const VoxelShadow one = bake(scene, light, options).shadow;
  options.threads = 4;
  const VoxelShadow four = bake(scene, light, options).shadow;
  ASSERT_EQ(one.dags().size(), four.dags().size());
  for (size_t i = 0; i < one.dags().size(); ++i) {
    EXPECT_TRUE(std::ranges::equal(one.dags()[i].grid, four.dags()[i].grid));
    EXPECT_TRUE(std::ranges::equal(one.dags()[i].nodes, four.dags()[i].nodes));
    EXPECT_TRUE(std::ranges::equal(one.dags()[i].leaves, four.dags()[i].leaves));
  }
}

TEST(RealPathOptions, BatchUnderASpotIsTheFilterAtTheMovedReceiver) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const Light light = spot();
  BakeOptions options;
  options.resolution = 2048;
  options.max_filter = 17;
  const VoxelShadow shadow = bake(random_bodies(random, 30), light, options).shadow;
  std::uniform_real_distribution<float> any(-1, 1);
  std::vector<SurfacePoint> points(20000);
  for (SurfacePoint& point : points) {
    point.position = glm::vec3(6, 1.5f, 6) * glm::vec3(any(random), any(random), any(random));
    if (random() % 8) point.normal = glm::normalize(glm::vec3(any(random), any(random), any(random)));
  }
  points[5].position = {2, 9, 1};  // behind the light
  std::vector<float> result(points.size());
  for (const uint32_t taps : {1u, 9u, 17u}) {
    shadow.visibility(points, taps, result);
    for (size_t i = 0; i < points.size(); ++i) {
      const glm::dvec3 world(points[i].position);
      const glm::dvec3 at = shadow.light().receiver_voxel(world, glm::dvec3(points[i].normal), taps);
      if (glm::any(glm::lessThan(glm::abs(at - glm::round(at)), glm::dvec3(1e-6)))) continue;
      const bool behind = (shadow.light().voxel_from_world * glm::dvec4(world, 1.0)).w <= 0;
      ASSERT_FLOAT_EQ(result[i], behind ? 1.0f : shadow.filtered(glm::ivec3(glm::floor(at)), taps)) << i << ' ' << taps;
    }
  }
}

}  // namespace
}  // namespace shadewright::voxel
