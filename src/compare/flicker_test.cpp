#include "shadewright/compare/flicker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "shadewright/error.h"

namespace shadewright::compare {
namespace {

constexpr uint32_t width = 96, height = 64;

/// A floor at y = 0 (instance 0) and a floating 2 x 2 sheet one metre above it (instance 1), which may move.
Scene floor_and_sheet(const glm::dvec3& sheet_moves_by = glm::dvec3(0)) {
  Scene scene;
  for (const float half : {30.0f, 1.0f}) {
    Mesh mesh;
    mesh.positions = {{-half, 0, -half}, {half, 0, -half}, {half, 0, half}, {-half, 0, half}};
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
    scene.instances.emplace_back().mesh = static_cast<uint32_t>(scene.meshes.size());
    scene.meshes.push_back(std::move(mesh));
  }
  scene.instances[1].world_from_mesh[3] = {0, 1, 0, 1};
  Motion motion;
  motion.times = {0, 1};
  motion.translations = {glm::dvec3(0), sheet_moves_by};
  motion.rotations = {{1, 0, 0, 0}, {1, 0, 0, 0}};
  scene.motions = {motion};
  scene.instances[1].motion = 0;
  return scene;
}

Camera camera_at_x(double x) {
  Camera camera;
  camera.eye = {x, 6, 8};
  camera.target = {x, 0, 0};
  return camera;
}

SeenFrame see(const Scene& scene, double time, const Camera& camera) {
  const Tracer tracer(scene, time);
  SeenFrame frame{time, {width, height, camera}, {}, {}, {}};
  const auto hits = tracer.primary(frame.grid, 0.01);
  for (size_t i = 0; i < hits.size(); ++i) {
    const glm::dvec3 ray = frame.grid.ray(static_cast<double>(i % width) + 0.5, static_cast<double>(i / width) + 0.5);
    frame.points.push_back({glm::vec3(camera.eye + double{hits[i].distance} * ray), hits[i].normal});
    frame.facing.push_back(hits[i].distance > 0);
  }
  frame.instances = instances_seen(tracer, frame.grid, 0.01, frame.points);
  return frame;
}

using Field = std::function<bool(const glm::vec3& position)>;

std::vector<uint8_t> sample(const SeenFrame& frame, const Field& field) {
  std::vector<uint8_t> values;
  for (const SurfacePoint& point : frame.points) values.push_back(point.valid() && field(point.position));
  return values;
}

/// Both ways, as a study counts.
FlickerCount flicker(const Scene& scene, const SeenFrame& a, const SeenFrame& b, const std::vector<uint8_t>& wrong_a,
                     const std::vector<uint8_t>& wrong_b) {
  FlickerCount count = count_flicker(reproject(scene, b, a), wrong_b, wrong_a);
  count += count_flicker(reproject(scene, a, b), wrong_a, wrong_b);
  return count;
}

size_t count(const std::vector<uint8_t>& values) {
  return static_cast<size_t>(std::count(values.begin(), values.end(), 1));
}

TEST(Flicker, AStillCameraComparesPixelWithPixel) {
  const Scene scene = floor_and_sheet();
  const SeenFrame frame = see(scene, 0, camera_at_x(0.3));
  std::vector<uint8_t> before(frame.points.size(), 0), after(frame.points.size(), 0);
  size_t changed = 0;
  for (size_t i = 0; i < before.size(); i += 7) before[i] = 1;
  for (size_t i = 0; i < after.size(); i += 5) after[i] = 1;
  for (size_t i = 0; i < after.size(); ++i) changed += frame.facing[i] && before[i] != after[i];
  const FlickerCount result = flicker(scene, frame, frame, before, after);
  EXPECT_EQ(result.points, 2 * count(frame.facing));
  EXPECT_EQ(result.changed, 2 * changed);
  EXPECT_DOUBLE_EQ(result.fraction(), static_cast<double>(changed) / static_cast<double>(count(frame.facing)));
  EXPECT_EQ(flicker(scene, frame, frame, before, before).changed, 0u);
}

TEST(Flicker, AnErrorThatKeepsStillInTheWorldDoesNotFlicker) {
  const Scene scene = floor_and_sheet();
  const SeenFrame a = see(scene, 0, camera_at_x(0)), b = see(scene, 0, camera_at_x(0.037));
  const Field stripes = [](const glm::vec3& p) { return std::fmod(p.x + 100.0f, 1.5f) < 0.5f; };
  const auto wrong_a = sample(a, stripes), wrong_b = sample(b, stripes);
  size_t other_pixels = 0;
  for (size_t i = 0; i < wrong_a.size(); ++i) other_pixels += wrong_a[i] != wrong_b[i];
  EXPECT_GT(other_pixels, 100u);  // the plain comparison of pixels would say so
  const FlickerCount still = flicker(scene, a, b, wrong_a, wrong_b);
  EXPECT_GT(still.points, 2 * count(a.facing) * 9 / 10);
  EXPECT_EQ(still.changed, 0u);
  // Stripes that swap are counted, all but their borders.
  const auto swapped = sample(b, [&](const glm::vec3& p) { return !stripes(p); });
  EXPECT_GT(flicker(scene, a, b, wrong_a, swapped).fraction(), 0.7);
}

TEST(Flicker, ThinErrorsCountWhenTheyComeAndWhenTheyGo) {
  const Scene scene = floor_and_sheet();
  const SeenFrame a = see(scene, 0, camera_at_x(0)), b = see(scene, 0, camera_at_x(0.037));
  std::vector<uint8_t> speck(a.points.size(), 0);
  const size_t pixel = size_t{height * 3 / 4} * width + width / 2;
  speck[pixel] = 1;
  const std::vector<uint8_t> clean(a.points.size(), 0);
  EXPECT_EQ(flicker(scene, a, b, speck, clean).changed, 1u);
  EXPECT_EQ(flicker(scene, a, b, clean, speck).changed, 1u);
}

TEST(Flicker, HiddenAndUncomparedPointsAreLeftOut) {
  Scene scene = floor_and_sheet();
  Camera behind = camera_at_x(0);
  behind.target.z = 16;
  const SeenFrame there = see(scene, 0, camera_at_x(0)), other_way = see(scene, 0, behind);
  const auto everywhere = [](const glm::vec3&) { return true; };
  EXPECT_EQ(flicker(scene, there, other_way, sample(there, everywhere), sample(other_way, everywhere)).points, 0u);
  // The sheet hides floor from one camera that another sees: nothing of the floor may be compared with the sheet.
  const SeenFrame aside = see(scene, 0, camera_at_x(0.6));
  const auto on_sheet = [](const glm::vec3& p) { return p.y > 0.5f; };
  EXPECT_EQ(flicker(scene, there, aside, sample(there, on_sheet), sample(aside, on_sheet)).changed, 0u);

  SeenFrame turned_away = there;
  turned_away.facing.assign(turned_away.facing.size(), 0);
  EXPECT_EQ(flicker(scene, there, turned_away, sample(there, on_sheet), sample(there, on_sheet)).points, 0u);
}

TEST(Flicker, PointsOnAMovedBodyAreFollowed) {
  const glm::dvec3 step(0.4, 0.1, -0.2);
  const Scene scene = floor_and_sheet(step);
  const SeenFrame a = see(scene, 0, camera_at_x(0)), b = see(scene, 1, camera_at_x(0));
  const auto on_body = [](const glm::dvec3& offset) {
    return [offset](const glm::vec3& p) { return p.y > 0.5f && std::fmod(p.x - float(offset.x) + 10.0f, 1.0f) < 0.5f; };
  };
  EXPECT_EQ(flicker(scene, a, b, sample(a, on_body({})), sample(b, on_body(step))).changed, 0u);
  // The same error at the same place of the world is another part of the body.
  EXPECT_GT(flicker(scene, a, b, sample(a, on_body({})), sample(b, on_body({}))).changed, 30u);
}

TEST(Flicker, KnowsInstancesButNotWhereTheDeviceDrewAnotherSurface) {
  const Scene scene = floor_and_sheet();
  SeenFrame frame = see(scene, 0, camera_at_x(0));
  size_t sheet = 0;
  for (size_t i = 0; i < frame.points.size(); ++i) {
    if (!frame.points[i].valid()) continue;
    ASSERT_EQ(frame.instances[i], frame.points[i].position.y > 0.5f ? 1u : 0u);
    sheet += frame.instances[i] == 1;
  }
  EXPECT_GT(sheet, 50u);
  for (SurfacePoint& point : frame.points) point.position += 0.01f * point.normal;
  for (const uint32_t instance : instances_seen(Tracer(scene), frame.grid, 0.01, frame.points))
    EXPECT_EQ(instance, ~0u);
}

TEST(Flicker, RefusesImagesOfAnotherSize) {
  const Scene scene = floor_and_sheet();
  const SeenFrame frame = see(scene, 0, camera_at_x(0));
  SeenFrame cut = frame;
  cut.facing.pop_back();
  EXPECT_THROW(reproject(scene, frame, cut), InputError);
}

}  // namespace
}  // namespace shadewright::compare
