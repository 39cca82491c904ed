#include "shadewright/raytrace/tracer.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "raytrace/queries.h"

namespace shadewright {
namespace {

// A square of half width `half` at height `y`, facing up.
Mesh square(float half, float y) {
  return {.name = "square",
          .positions = {{-half, y, -half}, {half, y, -half}, {half, y, half}, {-half, y, half}},
          .triangles = {{0, 2, 1}, {0, 3, 2}}};
}

// A 2 x 2 square one unit above a 20 x 20 floor, scaled and then moved.
Scene square_above_floor(double scale = 1, const glm::dvec3& offset = glm::dvec3(0)) {
  Scene scene;
  scene.meshes = {square(10, 0), square(1, 1)};
  scene.instances.resize(2);
  scene.instances[1].mesh = 1;
  for (Instance& instance : scene.instances) {
    instance.world_from_mesh = glm::dmat4(glm::dmat3(scale));
    instance.world_from_mesh[3] = glm::dvec4(offset, 1);
  }
  return scene;
}

// Many small turned squares in the air: rays cross instances' boxes all the time.
Scene confetti(uint32_t seed) {
  Scene scene;
  scene.meshes = {square(20, 0), square(0.3f, 0)};
  scene.instances.resize(1001);
  std::mt19937 engine(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  for (size_t i = 1; i < scene.instances.size(); ++i) {
    scene.instances[i].mesh = 1;
    const glm::dquat turn =
        glm::angleAxis(uniform(0, 3), glm::normalize(glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1))));
    glm::dmat4& world_from_mesh = scene.instances[i].world_from_mesh;
    world_from_mesh = glm::mat4_cast(turn);
    world_from_mesh[3] = glm::dvec4(uniform(-8, 8), uniform(0.5, 4), uniform(-8, 8), 1);
  }
  return scene;
}

PixelGrid grid_from(const glm::dvec3& eye, const glm::dvec3& target, uint32_t width = 160, uint32_t height = 90) {
  PixelGrid grid{.width = width, .height = height, .camera = {}};
  grid.camera.eye = eye;
  grid.camera.target = target;
  return grid;
}

std::vector<SurfacePoint> surface_points(const PixelGrid& grid, std::span<const PrimaryHit> hits) {
  std::vector<SurfacePoint> points(hits.size());
  for (size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].distance == 0) continue;
    const glm::dvec3 ray =
        grid.ray(static_cast<double>(i % grid.width) + 0.5, static_cast<double>(i / grid.width) + 0.5);
    points[i] = {glm::vec3(grid.camera.eye + double{hits[i].distance} * ray), hits[i].normal};
  }
  return points;
}

// The floor point of a unit scene, in the scaled and moved one.
SurfacePoint floor_point(double x, double z, double scale = 1, const glm::dvec3& offset = glm::dvec3(0)) {
  return {glm::vec3(glm::dvec3(x, 0, z) * scale + offset), {0, 1, 0}};
}

TEST(Tracer, SquareCastsItsShadowAlongTheSun) {
  const Light light = sun(0, 45);  // towards +X: the shadow is moved by -1 along x
  struct Case {
    double scale;
    glm::dvec3 offset;
  };
  for (const Case& c : {Case{1, glm::dvec3(0)}, Case{1e-3, glm::dvec3(0)}, Case{1e4, glm::dvec3(0)},
                        Case{1, glm::dvec3(1e3, -300, 2e3)}, Case{1e-3, glm::dvec3(0, 1, 2)}}) {
    const Tracer tracer(square_above_floor(c.scale, c.offset));
    std::vector<SurfacePoint> points;
    std::vector<uint8_t> expected;
    for (int i = 0; i < 400; ++i) {  // at least 0.01 from the boundary, which is far less than a float there
      const double x = -3.99 + i * 0.02;
      points.push_back(floor_point(x, 0.25, c.scale, c.offset));
      expected.push_back(!(x > -2 && x < 0));
    }
    const glm::vec3 eye(c.offset + c.scale * glm::dvec3(0, 5, 0));
    EXPECT_EQ(tracer.visible(points, eye, light), expected) << "scale " << c.scale;
  }
}

// The confetti drifting and turning, every other square: what a tracer brought to a time answers against one made
// there.
TEST(Tracer, UpdatedEqualsOneMadeAtThatTime) {
  Scene scene = confetti(5);
  for (uint32_t m = 0; m < 3; ++m) {
    Motion motion;
    motion.times = {0, 1, 3};
    motion.translations = {{0, 0, 0}, {1.5, 0.5 * m, -1}, {-2, 1, 0.5}};
    motion.rotations = {{1, 0, 0, 0}, glm::angleAxis(0.4, glm::dvec3(0, 1, 0)), {1, 0, 0, 0}};
    scene.motions.push_back(motion);
  }
  for (uint32_t i = 2; i < scene.instances.size(); i += 2) scene.instances[i].motion = i % 3;
  const PixelGrid grid = grid_from({6, 7, 9}, {0, 1, 0});
  const Light light = sun(30, 50);
  for (const size_t flatten_limit : {RayScene::flatten_limit_default, size_t{0}}) {
    RayScene updated(scene, 0, flatten_limit);
    for (const double time : {0.7, 2.5, 0.7, 9.0}) {
      updated.update(scene, time);
      const RayScene made(scene, time, flatten_limit);
      const auto hits = primary(updated, grid, 0.01), expected = primary(made, grid, 0.01);
      for (size_t i = 0; i < hits.size(); ++i) {
        ASSERT_EQ(hits[i].instance, expected[i].instance) << i;
        ASSERT_EQ(hits[i].distance, expected[i].distance) << i;
      }
      const auto points = surface_points(grid, hits);
      EXPECT_EQ(visible(updated, points, glm::vec3(grid.camera.eye), light, grid.width),
                visible(made, points, glm::vec3(grid.camera.eye), light, grid.width));
    }
  }
}

TEST(Tracer, ShadowBoundaryIsExact) {
  const Tracer tracer(square_above_floor());
  // Towards the sun (1, 1, 0), so from the ray's origin the edge at x = 0 lies exactly as far away as the offset is
  // high.
  const std::vector<SurfacePoint> points{floor_point(-1e-5, 0.25), floor_point(1e-5, 0.25),
                                         floor_point(-2 - 1e-5, 0.25), floor_point(-2 + 2e-5, 0.25)};
  EXPECT_EQ(tracer.visible(points, glm::vec3(0, 2, 0), sun(0, 45)), (std::vector<uint8_t>{0, 1, 1, 0}));
}

TEST(Tracer, PointsThatFaceAwayOrAreNothingAreDark) {
  const Tracer tracer(square_above_floor());
  const std::vector<SurfacePoint> points{{{5, 0, 0}, {0, 1, 0}}, {{5, 0, 0}, {0, -1, 0}}, {}};
  EXPECT_EQ(tracer.visible(points, glm::vec3(0, 5, 0), sun(0, 45)), (std::vector<uint8_t>{1, 0, 0}));
}

TEST(Tracer, PointLightReachesUpToItself) {
  const Tracer tracer(square_above_floor());
  Light light;
  light.kind = LightKind::point;
  light.position = {0, 2, 0};  // the shadow of the square at height 1 is twice its size
  std::vector<SurfacePoint> points{floor_point(1.99, 0.1), floor_point(2.01, 0.1), floor_point(0.3, -1.99)};
  EXPECT_EQ(tracer.visible(points, glm::vec3(0, 5, 0), light), (std::vector<uint8_t>{0, 1, 0}));
  light.position = {0, 0.5, 0};  // under the square: what lies behind the light casts nothing
  EXPECT_EQ(tracer.visible(points, glm::vec3(0, 5, 0), light), (std::vector<uint8_t>{1, 1, 1}));
}

TEST(Tracer, SpotLightEndsAtItsCone) {
  const Tracer tracer(square_above_floor());
  Light light;
  light.kind = LightKind::spot;
  light.position = {6, 3, 0};
  light.direction = {0, -1, 0};
  light.outer_angle = std::atan(1.0 / 3.0);  // a disc of radius 1 on the floor
  std::vector<SurfacePoint> points;
  std::vector<uint8_t> expected;
  for (const double angle : {0.1, 1.3, 2.9, 4.4})
    for (const double radius : {0.0, 0.5, 0.9999, 1.0001, 2.0}) {
      points.push_back(floor_point(6 + radius * std::cos(angle), radius * std::sin(angle)));
      expected.push_back(radius < 1);
    }
  EXPECT_EQ(tracer.visible(points, glm::vec3(0, 5, 0), light), expected);
}

TEST(Tracer, SegmentsAreCastAsTheyAre) {
  const Tracer tracer(square_above_floor());
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<Segment> segments{
      {{0.1f, 0.5f, 0.2f}, 0.49f, {0, 1, 0}, 1},  // ends below the square
      {{0.1f, 0.5f, 0.2f}, 0.51f, {0, 1, 0}, 1},  // ends above it
      {{0.1f, 0.5f, 0.2f}, infinity, {0, 1, 0}, 1}, {{0.1f, 0.5f, 0.2f}, infinity, {0, 1, 0}, 0},
      {{3.0f, 0.5f, 0.2f}, infinity, {0, 1, 0}, 1}, {{3.0f, 0.5f, 0.2f}, 2.0f, {0, -0.2f, 0}, 1},
      {{3.0f, 0.5f, 0.2f}, 3.0f, {0, -0.2f, 0}, 1}};
  EXPECT_EQ(tracer.unoccluded(segments), (std::vector<uint8_t>{1, 0, 0, 1, 1, 1, 0}));
}

TEST(Tracer, PrimaryHitsTellDepthAndTriangle) {
  const Tracer tracer(square_above_floor());
  const PixelGrid grid = grid_from({0, 5, 0}, {0, 0, 0}, 64, 48);
  const std::vector<PrimaryHit> hits = tracer.primary(grid, 0.01);
  ASSERT_EQ(hits.size(), 64u * 48u);
  const PrimaryHit& center = hits[24 * 64 + 32];
  EXPECT_EQ(center.instance, 1u);
  EXPECT_FLOAT_EQ(center.distance, 4.0f);
  EXPECT_EQ(center.normal, glm::vec3(0, 1, 0));
  EXPECT_EQ(hits[0].instance, 0u);
  EXPECT_FLOAT_EQ(hits[0].distance, 5.0f);
}

TEST(Tracer, PrimaryDepthIsThePlanes) {
  const Tracer tracer(square_above_floor());
  const PixelGrid grid = grid_from({2, 3, 7}, {0, 0.5, 0});
  const std::vector<PrimaryHit> hits = tracer.primary(grid, 0.01);
  std::array<int, 2> seen{};
  for (uint32_t y = 0; y < grid.height; ++y)
    for (uint32_t x = 0; x < grid.width; ++x) {
      const PrimaryHit& hit = hits[y * grid.width + x];
      const glm::dvec3 ray = grid.ray(x + 0.5, y + 0.5), eye = grid.camera.eye;
      const auto at_height = [&](double height) { return eye + (height - eye.y) / ray.y * ray; };
      const bool on_square = ray.y < 0 && std::abs(at_height(1).x) < 1 && std::abs(at_height(1).z) < 1;
      const bool on_floor = ray.y < 0 && std::abs(at_height(0).x) < 10 && std::abs(at_height(0).z) < 10;
      if (!on_square && !on_floor) {
        EXPECT_EQ(hit.distance, 0);
        EXPECT_EQ(hit.normal, glm::vec3(0));
        EXPECT_EQ(hit.instance, ~0u);
        continue;
      }
      EXPECT_EQ(hit.instance, on_square ? 1u : 0u);
      EXPECT_FLOAT_EQ(hit.distance, static_cast<float>(((on_square ? 1 : 0) - eye.y) / ray.y));
      ++seen[hit.instance];
    }
  EXPECT_GT(seen[0], 1000);
  EXPECT_GT(seen[1], 100);
}

TEST(Tracer, InstancedAndFlattenedAgree) {
  const Scene scene = confetti(3);
  const RayScene flattened(scene, 0), instanced(scene, 0, 0);
  ASSERT_FALSE(flattened.instanced());
  ASSERT_TRUE(instanced.instanced());
  const PixelGrid grid = grid_from({9, 8, 12}, {0, 1, 0});
  const auto a = primary(flattened, grid, 0.01), b = primary(instanced, grid, 0.01);
  size_t differ = 0;  // an edge may fall on either side of a pixel's centre
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i].instance != b[i].instance || a[i].triangle != b[i].triangle) {
      ++differ;
      continue;
    }
    EXPECT_EQ(a[i].distance, b[i].distance);
    EXPECT_EQ(a[i].normal, b[i].normal);
  }
  EXPECT_LE(differ, 2u);
  const std::vector<SurfacePoint> points = surface_points(grid, a);
  const auto lit_a = visible(flattened, points, glm::vec3(grid.camera.eye), sun(20, 50), grid.width);
  const auto lit_b = visible(instanced, points, glm::vec3(grid.camera.eye), sun(20, 50), grid.width);
  differ = 0;
  for (size_t i = 0; i < lit_a.size(); ++i) differ += lit_a[i] != lit_b[i];
  EXPECT_LE(differ, 2u);
  EXPECT_GT(std::ranges::count(lit_a, 1), 2000);
  EXPECT_GT(std::ranges::count(lit_a, 0), 2000);
}

TEST(Tracer, MotionMovesTheCaster) {
  Scene scene = square_above_floor();
  scene.motions.push_back({.name = "slide",
                           .times = {0, 1},
                           .translations = {glm::dvec3(0), glm::dvec3(5, 0, 0)},
                           .rotations = {glm::dquat(1, 0, 0, 0), glm::dquat(1, 0, 0, 0)}});
  scene.instances[1].motion = 0;
  const std::vector<SurfacePoint> points{floor_point(-1, 0.25), floor_point(4, 0.25)};
  const glm::vec3 eye(0, 5, 0);
  EXPECT_EQ(Tracer(scene, 0).visible(points, eye, sun(0, 45)), (std::vector<uint8_t>{0, 1}));
  EXPECT_EQ(Tracer(scene, 1).visible(points, eye, sun(0, 45)), (std::vector<uint8_t>{1, 0}));
}

TEST(Tracer, SupersamplingMeasuresCoverage) {
  // From straight above, the shadow of the square ends at x = 0 and x = -2, which cut through pixels 1/8 unit wide.
  const Tracer tracer(square_above_floor());
  PixelGrid grid = grid_from({0.03, 40, 0}, {0.03, 0, 0}, 64, 64);
  grid.camera.fov_y = 2 * std::atan(4.0 / 40.0);
  std::vector<SurfacePoint> points;
  std::vector<double> x_world;
  const double pixel = 8.0 / 64;
  for (uint32_t y = 0; y < 64; ++y)
    for (uint32_t x = 0; x < 64; ++x) {
      const glm::dvec3 ray = grid.ray(x + 0.5, y + 0.5);
      points.push_back({glm::vec3(grid.camera.eye - grid.camera.eye.y / ray.y * ray), {0, 1, 0}});
      x_world.push_back(points.back().position.x);
    }
  const std::vector<float> lit = tracer.visible_supersampled(points, grid, sun(0, 45), 64);
  double difference = 0;
  size_t edges = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    if (std::abs(points[i].position.z) > 0.9) continue;
    const auto covered = [&](double from) { return std::clamp((from - x_world[i]) / pixel + 0.5, 0.0, 1.0); };
    const double expected = 1 - (covered(0) - covered(-2));
    EXPECT_NEAR(lit[i], expected, 2.0 / 64 + 1e-3);  // 64 samples are stratified into 64 columns
    if (expected > 0 && expected < 1) {
      ++edges;
      difference += lit[i] - expected;
    }
  }
  EXPECT_GE(edges, 14u);
  EXPECT_NEAR(difference / static_cast<double>(edges), 0, 0.01);
}

TEST(Tracer, SupersamplingKeepsAGrazingFloorLit) {
  Scene scene;
  scene.meshes = {square(1000, 0)};
  scene.instances.resize(1);
  const Tracer tracer(scene);
  const PixelGrid grid = grid_from({0, 1, 0}, {100, 0, 30});
  std::vector<SurfacePoint> points = surface_points(grid, tracer.primary(grid, 0.01));
  for (size_t i = 0; i < points.size(); ++i)  // normals as coarse as a camera pass may store them
    if (points[i].valid()) points[i].normal = glm::normalize(glm::vec3(i % 2 ? 7e-5f : -7e-5f, 1, i % 3 ? 0 : 7e-5f));
  const std::vector<float> lit = tracer.visible_supersampled(points, grid, sun(35, 5), 4);
  for (size_t i = 0; i < points.size(); ++i) EXPECT_EQ(lit[i], points[i].valid() ? 1.0f : 0.0f) << "pixel " << i;
}

TEST(Tracer, ResultsDoNotDependOnThreads) {
  const Scene scene = confetti(5);
  const PixelGrid grid = grid_from({9, 8, 12}, {0, 1, 0}, 161, 91);
  const auto run = [&](size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const Tracer tracer(scene);
    const std::vector<SurfacePoint> points = surface_points(grid, tracer.primary(grid, 0.01));
    return std::pair(tracer.visible(points, glm::vec3(grid.camera.eye), sun(20, 50), grid.width),
                     tracer.visible_supersampled(points, grid, sun(20, 50), 16));
  };
  EXPECT_EQ(run(1), run(2));
}

TEST(Tracer, EmptyInputs) {
  const Tracer tracer(Scene{});
  EXPECT_TRUE(tracer.visible({}, glm::vec3(0), sun(0, 45)).empty());
  EXPECT_EQ(tracer.visible(std::vector<SurfacePoint>{floor_point(0, 0)}, glm::vec3(0), sun(0, 45)),
            std::vector<uint8_t>{1});
  EXPECT_EQ(tracer.primary(grid_from({0, 1, 0}, {1, 0, 0}, 2, 1), 0.01)[0].distance, 0);
}

}  // namespace
}  // namespace shadewright
