// The reference path and the single look-up against the maps they were made from, and the filter against its
// definition.
#include <gtest/gtest.h>

#include <random>

#include "shadewright/error.h"
#include "shadewright/voxel/bake.h"

namespace shadewright::voxel {
namespace {

constexpr uint32_t kSize = 64;

LightGrid unit_grid() {
  LightGrid grid;
  grid.log2_size = grid.log2_depth = 6;
  grid.voxel_from_world = glm::dmat4(double(kSize));
  grid.voxel_from_world[3][3] = 1;
  grid.texel_size = glm::dvec2(1.0 / kSize);
  grid.voxel_depth = 1.0 / kSize;
  return grid;
}

/// Patches of depths, so that there are uniform nodes too.
std::vector<float> random_map(std::mt19937& random, float low, float high) {
  std::uniform_real_distribution<float> depth(low, high);
  std::vector<float> map(size_t(kSize) * kSize, 2.0f);
  for (int patch = 0; patch < 20; ++patch) {
    const uint32_t x = uint32_t(random()) % kSize, y = uint32_t(random()) % kSize, side = 1 + uint32_t(random()) % 24;
    const float base = depth(random), slope = (depth(random) - low) * 0.02f;
    for (uint32_t j = y; j < std::min(y + side, kSize); ++j)
      for (uint32_t i = x; i < std::min(x + side, kSize); ++i) map[j * kSize + i] = base + slope * float(i - x);
  }
  return map;
}

TEST(ReferencePath, AgreesWithItsMapInEveryVoxel) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const std::vector<float> depth = random_map(random, 0.0f, 1.1f);
  const VoxelShadow shadow = bake_depth_map(depth, {}, unit_grid(), 17);
  for (int z = 0; z < int(kSize); ++z)
    for (int y = 0; y < int(kSize); ++y)
      for (int x = 0; x < int(kSize); ++x)
        ASSERT_EQ(shadow.visible({x, y, z}), (z + 0.5) / kSize <= double(depth[size_t(y) * kSize + size_t(x)]))
            << x << ' ' << y << ' ' << z;
}

TEST(ReferencePath, IsRightWhereDefined) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const std::vector<float> depth = random_map(random, 0.0f, 1.1f);
  std::vector<float> exit = random_map(random, 0.0f, 1.1f);
  for (size_t i = 0; i < exit.size(); ++i) exit[i] = std::max(exit[i], depth[i]);
  const VoxelShadow shadow = bake_depth_map(depth, exit, unit_grid(), 1),
                    full = bake_depth_map(depth, {}, unit_grid(), 1);
  EXPECT_LT(shadow.dag_bytes(), full.dag_bytes());
  for (int z = 0; z < int(kSize); ++z)
    for (int y = 0; y < int(kSize); ++y)
      for (int x = 0; x < int(kSize); ++x) {
        const size_t at = size_t(y) * kSize + size_t(x);
        const double center = (z + 0.5) / kSize;
        if (center > double(depth[at]) && center <= double(exit[at])) continue;
        ASSERT_EQ(shadow.visible({x, y, z}), center <= double(depth[at])) << x << ' ' << y << ' ' << z;
      }
}

TEST(Lookup, FilterIsTheMeanOfItsVoxels) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const VoxelShadow shadow = bake_depth_map(random_map(random, 0.0f, 1.0f), {}, unit_grid(), 17);
  for (int i = 0; i < 2000; ++i) {
    const glm::ivec3 at = glm::ivec3(random() % 80, random() % 80, random() % 80) - 8;
    for (const int taps : {1, 3, 7, 9, 11, 17}) {
      int lit = 0;
      for (int y = -taps / 2; y <= taps / 2; ++y)
        for (int x = -taps / 2; x <= taps / 2; ++x) lit += shadow.visible(at + glm::ivec3(x, y, 0));
      ASSERT_FLOAT_EQ(shadow.filtered(at, uint32_t(taps)), float(lit) / float(taps * taps));
    }
  }
}

TEST(Lookup, BatchIsTheFilterAtTheMovedReceiver) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const VoxelShadow shadow = bake_depth_map(random_map(random, 0.0f, 1.0f), {}, unit_grid(), 17);
  std::uniform_real_distribution<float> unit(-0.2f, 1.2f), any(-1, 1);
  std::vector<SurfacePoint> points(5003);
  for (SurfacePoint& point : points) {
    point.position = {unit(random), unit(random), unit(random)};
    if (random() % 8) point.normal = glm::normalize(glm::vec3(any(random), any(random), any(random)));
  }
  points[7].position.x = std::numeric_limits<float>::quiet_NaN();
  points[8].position.y = std::numeric_limits<float>::infinity();
  points[9].position.z = -1e30f;
  points[10].position.x = 1e30f;
  std::vector<float> result(points.size());
  for (const uint32_t taps : {1u, 3u, 5u, 9u, 13u, 17u}) {
    shadow.visibility(points, taps, result);
    for (size_t i = 0; i < points.size(); ++i) {
      const glm::dvec3 at =
          shadow.light().receiver_voxel(glm::dvec3(points[i].position), glm::dvec3(points[i].normal), taps);
      if (!(glm::length(at) < 1e6)) {
        ASSERT_EQ(result[i], 1.0f);
        continue;
      }
      // The batch rounds otherwise: a receiver on the border of two voxels may fall into either.
      if (glm::any(glm::lessThan(glm::abs(at - glm::round(at)), glm::dvec3(1e-6)))) continue;
      ASSERT_FLOAT_EQ(result[i], shadow.filtered(glm::ivec3(glm::floor(at)), taps)) << i << " taps " << taps;
    }
  }
}

TEST(Lookup, AMovedWorldHasTheSameShadow) {
  const uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const VoxelShadow shadow = bake_depth_map(random_map(random, 0.0f, 1.0f), {}, unit_grid(), 5);
  const VoxelShadow moved = shadow.moved({8, -4, 16});
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<SurfacePoint> points(500), moved_points;
  for (SurfacePoint& point : points) point = {glm::vec3(unit(random), unit(random), unit(random)), glm::vec3(0, 1, 0)};
  // On the moved points' own steps, so that moving them back loses nothing.
  for (SurfacePoint& point : points) point.position = glm::round(point.position * 65536.0f) / 65536.0f;
  for (const SurfacePoint& point : points)
    moved_points.push_back({point.position + glm::vec3(8, -4, 16), point.normal});
  std::vector<float> here(points.size()), there(points.size());
  shadow.visibility(points, 3, here);
  moved.visibility(moved_points, 3, there);
  EXPECT_EQ(here, there);
}

TEST(Lookup, RefusesFiltersThatWereNotBaked) {
  const std::vector<float> depth(size_t(kSize) * kSize, 0.5f);
  const VoxelShadow shadow = bake_depth_map(depth, {}, unit_grid(), 5);
  EXPECT_THROW(shadow.filtered({1, 1, 1}, 7), InputError);
  EXPECT_THROW(shadow.filtered({1, 1, 1}, 4), InputError);
  EXPECT_NO_THROW(shadow.filtered({1, 1, 1}, 5));
}

}  // namespace
}  // namespace shadewright::voxel
