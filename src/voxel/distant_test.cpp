// MRAA against the coarse DAG's own filter, VOAA against counted voxels.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "shadewright/error.h"
#include "shadewright/voxel/bake.h"
#include "test_scenes.h"

namespace shadewright::voxel {
namespace {

class DistantLookup : public testing::Test {
 protected:
  DistantLookup() {
    std::mt19937 random(17);
    BakeOptions options;
    options.resolution = 512;
    options.pyramid = true;
    Light light;
    light.direction = glm::normalize(glm::dvec3(0.3, -1, 0.2));
    shadow_ = bake(random_bodies(random, 30), light, options).shadow;
    std::uniform_real_distribution<float> any(-1, 1);
    points_.resize(3000);
    for (SurfacePoint& point : points_)
      point = {glm::vec3(6, 1.5f, 6) * glm::vec3(any(random), any(random), any(random)), {0, 1, 0}};
  }
  std::vector<float> ask(float footprint, uint32_t taps, Distant how) const {
    std::vector<float> result(points_.size()), footprints(points_.size(), footprint);
    shadow_.distant_visibility(points_, footprints, taps, how, result);
    return result;
  }
  double texel() const { return std::sqrt(shadow_.light().texel_size.x * shadow_.light().texel_size.y); }

  VoxelShadow shadow_;
  std::vector<SurfacePoint> points_;
};

TEST_F(DistantLookup, NearPointsAreFilteredAsUsual) {
  std::vector<float> usual(points_.size());
  shadow_.visibility(points_, 9, usual);
  EXPECT_EQ(ask(float(8.9 * texel()), 9, Distant::mraa), usual);
  EXPECT_EQ(ask(float(8.9 * texel()), 9, Distant::voaa), usual);
}

TEST_F(DistantLookup, PyramidFiltersTheCoarserDag) {
  const std::vector<float> result = ask(float(13.0 * texel()), 3, Distant::mraa);  // floor(log2(13 / 3)) = 2
  const LightGrid coarse = shadow_.light().halved().halved();
  const VoxelShadow second({coarse, 3, 0, false, false}, {shadow_.dags()[2]}, {{0}}, nullptr);
  std::vector<float> expected(points_.size());
  std::vector<SurfacePoint> moved = points_;
  for (SurfacePoint& point : moved)
    point = {glm::vec3(coarse.distant_receiver(glm::dvec3(point.position), glm::dvec3(point.normal), 1.5)), {0, 0, 0}};
  second.visibility(moved, 3, expected);
  EXPECT_EQ(result, expected);
}

TEST_F(DistantLookup, OccupancyIsTheShareOfVisibleVoxels) {
  const std::vector<float> result = ask(float(32.0 * texel()), 3, Distant::voaa);  // nodes half as wide
  for (size_t i = 0; i < points_.size(); i += 10) {
    const LightGrid& light = shadow_.light();
    const glm::dvec3 world(points_[i].position);
    const glm::ivec3 corner = LightGrid::clear_node(light.voxel(world), light.plane_slope(world, {0, 1, 0}), 4)
                              << glm::ivec3(4);
    if (glm::any(glm::lessThan(corner, glm::ivec3(0))) || glm::any(glm::greaterThan(corner, glm::ivec3(496)))) continue;
    int lit = 0;
    for (int v = 0; v < 16 * 16 * 16; ++v) lit += shadow_.visible(corner + glm::ivec3(v & 15, v >> 4 & 15, v >> 8));
    // The side is 16 up to float rounding of the footprint, hence a trace of the next height.
    EXPECT_NEAR(result[i], double(lit) / 4096, 1e-3) << i;
  }
}

/// However wide the pixel and wherever the nodes lie in its plane.
TEST(DistantReceivers, OpenGroundDoesNotShadeItself) {
  Scene scene;
  scene.meshes.resize(1);
  scene.meshes[0].positions = {{-8, 0.1f, -8}, {8, -0.7f, -8}, {8, 0.4f, 8}, {-8, 1.2f, 8}};
  scene.meshes[0].triangles = {{0, 2, 1}, {0, 3, 2}};
  scene.instances.resize(1);
  const glm::vec3 a = scene.meshes[0].positions[0], across = scene.meshes[0].positions[1] - a,
                  down = scene.meshes[0].positions[3] - a;
  const glm::vec3 normal = glm::normalize(glm::cross(down, across));
  Light light;
  light.direction = glm::normalize(glm::dvec3(0.8, -1, 0.35));
  BakeOptions options;
  options.resolution = 1024;
  options.pyramid = true;
  const VoxelShadow shadow = bake(scene, light, options).shadow;
  std::mt19937 random(2014);
  std::uniform_real_distribution<float> any(0.1f, 0.9f);
  std::vector<SurfacePoint> points(4000);
  for (SurfacePoint& point : points) point = {a + any(random) * across + any(random) * down, normal};
  const double texel = std::sqrt(shadow.light().texel_size.x * shadow.light().texel_size.y);
  for (const Distant how : {Distant::voaa, Distant::mraa})
    for (const double texels : {10.0, 17.0, 33.0, 50.0, 100.0}) {
      const std::vector<float> footprints(points.size(), static_cast<float>(texels * texel));
      std::vector<float> result(points.size());
      shadow.distant_visibility(points, footprints, 9, how, result);
      EXPECT_EQ(std::ranges::count(result, 1.0f), static_cast<std::ptrdiff_t>(points.size())) << texels;
    }
}

TEST_F(DistantLookup, RefusesWhatWasNotBaked) {
  BakeOptions options;
  options.resolution = 64;
  std::mt19937 random(1);
  const VoxelShadow plain = bake(random_bodies(random, 3), Light{}, options).shadow;
  std::vector<float> result(points_.size()), footprints(points_.size(), 1.0f);
  EXPECT_THROW(plain.distant_visibility(points_, footprints, 3, Distant::mraa, result), InputError);
  footprints.pop_back();
  EXPECT_THROW(plain.distant_visibility(points_, footprints, 3, Distant::voaa, result), InputError);
}

}  // namespace
}  // namespace shadewright::voxel
