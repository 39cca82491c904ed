#include "shadewright/scene/scene.h"
#include "shadewright/scene/moments.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "shadewright/error.h"
#include "shadewright/geometry/projection.h"

namespace shadewright {
namespace {

Mesh unit_square() {
  return {"square", {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {{0, 2, 1}, {0, 3, 2}}};
}

Scene two_squares() {
  Scene scene;
  scene.meshes = {unit_square()};
  scene.instances.resize(2);
  scene.instances[1].world_from_mesh = glm::translate(glm::dmat4(1.0), {10, 1, 0});
  return scene;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], tolerance) << "axis " << axis;
}

std::string error_of(const auto& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(Scene, HasBoundsAndCountsInstances) {
  const Scene scene = two_squares();
  EXPECT_EQ(triangle_count(scene), 4u);
  EXPECT_EQ(bounds(scene).max, glm::dvec3(11, 1, 1));
  EXPECT_EQ(bounds(scene).min, glm::dvec3(0));
  EXPECT_TRUE(bounds(Mesh{}).empty());
  EXPECT_TRUE(bounds(Scene{}).empty());
}

TEST(Scene, BoundsIgnoreUnusedVertices) {
  Mesh mesh = unit_square();
  mesh.positions.emplace_back(1000.0f);
  EXPECT_EQ(bounds(mesh).max, glm::dvec3(1, 0, 1));
}

TEST(Sun, ShinesFromItsAzimuthAndElevation) {
  expect_near(sun(0, 0).direction, {-1, 0, 0});
  expect_near(sun(90, 0).direction, {0, 0, -1});
  expect_near(sun(12, 90).direction, {0, -1, 0});
  expect_near(sun(90, 45).direction, {0, -std::sqrt(0.5), -std::sqrt(0.5)});
  for (const double quarter : {-90.0, 90.0, 270.0, 450.0}) EXPECT_EQ(sun(quarter, 30).direction.x, 0) << quarter;
  for (const double half : {-180.0, 0.0, 180.0, 360.0}) EXPECT_EQ(sun(half, 30).direction.z, 0) << half;
  EXPECT_EQ(sun(35, 90).direction, glm::dvec3(0, -1, 0));
}

TEST(Find, ListsWhatThereIs) {
  Scene scene;
  EXPECT_EQ(error_of([&] { find_light(scene, "lamp"); }),
            "light \"lamp\": the scene has no light at all; leave the name out");
  scene.cameras.resize(2);
  scene.cameras[0].name = "wall";
  scene.cameras[1].name = "furball";
  EXPECT_EQ(&find_camera(scene, "furball"), &scene.cameras[1]);
  EXPECT_EQ(error_of([&] { find_camera(scene, "roof"); }),
            "camera \"roof\": the scene has no camera of this name; use one of: wall, furball");
  scene.paths.resize(1);
  scene.paths[0].name = "walk";
  EXPECT_EQ(&find_path(scene, "walk"), &scene.paths[0]);
}

TEST(Motion, IsHeldAtItsEndsAndRigidBetween) {
  Scene scene = two_squares();
  Motion motion;
  motion.times = {1.0, 3.0};
  motion.translations = {{0, 0, 0}, {4, 0, 0}};
  motion.rotations = {glm::dquat(1, 0, 0, 0), glm::angleAxis(glm::radians(90.0), glm::dvec3(0, 1, 0))};
  scene.motions = {motion, Motion{}};
  Instance& instance = scene.instances[1];
  instance.motion = 0;
  EXPECT_EQ(transform_at(scene, instance, 0.0), instance.world_from_mesh);
  EXPECT_EQ(transform_at(scene, instance, -INFINITY), instance.world_from_mesh);
  // Half way: turned by 45 degrees about Y, moved by 2.
  expect_near(glm::dvec3(transform_at(scene, instance, 2.0)[3]), {2 + 10 * std::sqrt(0.5), 1, -10 * std::sqrt(0.5)});
  EXPECT_NEAR(glm::determinant(glm::dmat3(transform_at(scene, instance, 2.5))), 1.0, 1e-12);
  expect_near(glm::dvec3(transform_at(scene, instance, 99.0)[3]), {4, 1, -10});
  instance.motion = 1;
  EXPECT_EQ(transform_at(scene, instance, 2.0), instance.world_from_mesh);
}

TEST(CameraPath, PassesThroughItsKeysSmoothly) {
  CameraPath path;
  path.times = {0, 1, 3, 4};
  path.keys.resize(4);
  for (size_t i = 0; i < 4; ++i) {
    path.keys[i].eye = {path.times[i], double(i * i), 0};
    path.keys[i].near = 0.5;
  }
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(camera_at(path, path.times[i]).eye, path.keys[i].eye);
  EXPECT_EQ(camera_at(path, -1).eye, path.keys[0].eye);
  EXPECT_EQ(camera_at(path, 9).eye, path.keys[3].eye);
  EXPECT_EQ(camera_at(path, 2).near, 0.5);
  const double step = 1e-6;
  for (const double time : {1.0, 3.0}) {
    const glm::dvec3 before = (camera_at(path, time).eye - camera_at(path, time - step).eye) / step;
    const glm::dvec3 after = (camera_at(path, time + step).eye - camera_at(path, time).eye) / step;
    expect_near(before, after, 1e-4);
  }
  // Keys on a straight line at constant speed stay on it, however they are spaced.
  EXPECT_NEAR(camera_at(path, 2.2).eye.x, 2.2, 1e-12);
  EXPECT_EQ(camera_at(CameraPath{}, 1.0).eye, Camera{}.eye);
}

/// True when every corner of `box` projects inside an image of this aspect.
bool frames(const Scene& scene, const Camera& camera, const Box& box, double aspect) {
  const glm::dmat4 clip_from_world = perspective_reversed_infinite(camera.fov_y, aspect, near_distance(scene, camera)) *
                                     look_along(camera.eye, camera.target - camera.eye, camera.up);
  for (const glm::dvec3& corner : box.corners()) {
    const glm::dvec4 c = clip_from_world * glm::dvec4(corner, 1.0);
    if (c.w <= 0 || std::abs(c.x) > c.w || std::abs(c.y) > c.w) return false;
  }
  return true;
}

TEST(DefaultCamera, SeesTheWholeScene) {
  const Scene scene = two_squares();
  const Camera camera = default_camera(scene);
  EXPECT_TRUE(frames(scene, camera, bounds(scene), 16.0 / 9.0));
  EXPECT_LT(glm::distance(camera.eye, bounds(scene).center()), 3 * bounds(scene).diagonal());
  EXPECT_EQ(default_camera(Scene{}).eye, Camera{}.eye);
}

TEST(DefaultCamera, FramesTheContentNotTheBackdrop) {
  Scene scene;
  scene.meshes = {unit_square()};
  for (int i = 0; i < 400; ++i) {
    Instance instance;
    instance.world_from_mesh = glm::translate(glm::dmat4(1.0), {i % 20, 0, i / 20});
    scene.instances.push_back(instance);
  }
  const Box content = bounds(scene);
  Instance backdrop;
  backdrop.world_from_mesh = glm::scale(glm::translate(glm::dmat4(1.0), {5000, 0, 0}), glm::dvec3(1000));
  scene.instances.push_back(backdrop);
  const Camera camera = default_camera(scene);
  EXPECT_LT(glm::distance(camera.eye, content.center()), 3 * content.diagonal());
}

TEST(NearDistance, IsTheCamerasOwnOrFollowsTheScale) {
  const Scene scene = two_squares();
  Camera camera;
  camera.near = 0.3;
  EXPECT_EQ(near_distance(scene, camera), 0.3);
  camera.near = 0;
  camera.target = camera.eye + glm::dvec3(0, 0, -2);
  EXPECT_DOUBLE_EQ(near_distance(scene, camera), 2e-4);
  camera.target = camera.eye + glm::dvec3(0, 0, -1e9);
  EXPECT_DOUBLE_EQ(near_distance(scene, camera), 1e-4 * bounds(scene).diagonal());
}

TEST(Recentre, LeavesScenesNearZeroAlone) {
  Scene scene = two_squares();
  const glm::dmat4 before = scene.instances[1].world_from_mesh;
  recentre(scene);
  EXPECT_EQ(scene.origin, glm::dvec3(0));
  EXPECT_EQ(scene.instances[1].world_from_mesh, before);
  EXPECT_EQ(scene.meshes[0].positions, unit_square().positions);
}

TEST(Recentre, MovesFarVerticesExactly) {
  Scene scene = two_squares();
  for (glm::vec3& p : scene.meshes[0].positions) p += glm::vec3(1000003.0f, 7.0f, -500001.0f);
  const Mesh far_mesh = scene.meshes[0];
  const Scene far_scene = scene;
  scene.cameras.resize(1);
  scene.cameras[0].eye = {1000003, 12, -500001};
  recentre(scene);
  EXPECT_LT(glm::length(bounds(scene.meshes[0]).center()), 10.0);
  EXPECT_LT(glm::length(bounds(scene).center()), 100.0);
  EXPECT_LT(glm::length(scene.cameras[0].eye), 100.0);
  for (size_t i = 0; i < 2; ++i) {
    for (size_t k = 0; k < 4; ++k) {
      const glm::dmat4 world = scene.instances[i].world_from_mesh, far_world = far_scene.instances[i].world_from_mesh;
      EXPECT_EQ(glm::dvec3(world * glm::dvec4(scene.meshes[0].positions[k], 1)) + scene.origin,
                glm::dvec3(far_world * glm::dvec4(far_mesh.positions[k], 1)));
    }
  }
}

TEST(Recentre, KeepsMotionsOnTheirWay) {
  Scene scene = two_squares();
  for (Instance& instance : scene.instances) instance.world_from_mesh[3] += glm::dvec4(1e6, 0, 1e6, 0);
  Motion motion;
  motion.times = {0, 1};
  motion.translations = {{0, 0, 0}, {3, 0, 0}};
  motion.rotations = {glm::dquat(1, 0, 0, 0), glm::angleAxis(1e-5, glm::dvec3(0, 1, 0))};
  scene.motions = {motion, Motion{}};
  scene.instances[0].motion = 0;
  scene.instances[1].motion = 1;
  const Scene before = scene;
  recentre(scene);
  EXPECT_GT(glm::length(scene.origin), 1e6);
  for (size_t i = 0; i < 2; ++i)
    for (const double time : {0.0, 0.3, 1.0})
      expect_near(glm::dvec3(transform_at(scene, scene.instances[i], time)[3]) + scene.origin,
                  glm::dvec3(transform_at(before, before.instances[i], time)[3]), 1e-8);
}

TEST(DropDegenerate, KeepsOnlyTrianglesWithArea) {
  Scene scene = two_squares();
  Mesh& mesh = scene.meshes[0];
  mesh.positions.emplace_back(NAN, 0, 0);
  mesh.positions.emplace_back(0.5f, 0, 0.5f);
  mesh.triangles.emplace_back(0, 1, 4);   // not finite
  mesh.triangles.emplace_back(0, 2, 5);   // collinear
  mesh.triangles.emplace_back(0, 0, 1);   // repeated
  mesh.triangles.emplace_back(0, 1, 77);  // no such vertex
  scene.meshes.insert(scene.meshes.begin(), Mesh{"nothing", {{0, 0, 0}}, {{0, 0, 0}}});
  scene.instances[0].mesh = 0;
  scene.instances[1].mesh = 1;
  EXPECT_EQ(drop_degenerate_triangles(scene), 5u);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].triangles, unit_square().triangles);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].mesh, 0u);
}

TEST(DropDegenerate, KeepsVerySmallAndVeryLargeTriangles) {
  for (const float scale : {1e-30f, 1e-6f, 1e30f}) {
    Scene scene = two_squares();
    for (glm::vec3& p : scene.meshes[0].positions) p *= scale;
    EXPECT_EQ(drop_degenerate_triangles(scene), 0u) << scale;
  }
}

TEST(Moments, CoverThePathFromItsFirstKeyToItsLast) {
  CameraPath path;
  path.times = {2, 3, 6};
  path.keys.resize(3);
  path.keys[2].eye = {4, 0, 0};
  const auto moments = moments_along(path, sun(10, 20), 5);
  ASSERT_EQ(moments.size(), 5u);
  for (size_t i = 0; i < moments.size(); ++i) {
    EXPECT_DOUBLE_EQ(moments[i].time, 2 + static_cast<double>(i));
    EXPECT_EQ(moments[i].camera.eye, camera_at(path, moments[i].time).eye);
  }
  EXPECT_EQ(moments_along(path, sun(10, 20), 1).front().time, 2);
  EXPECT_THROW(moments_along(CameraPath{}, sun(10, 20), 2), InputError);
}

TEST(Moments, CoverAllMotionsWithAStillCamera) {
  Scene scene;
  scene.motions.resize(3);
  scene.motions[0].times = {1, 2};
  scene.motions[1].times = {-1, 1.5};
  Camera camera;
  camera.eye = {1, 2, 3};
  const auto moments = moments_of_motions(scene, camera, sun(0, 45), 4);
  EXPECT_EQ(moments.front().time, -1);
  EXPECT_EQ(moments.back().time, 2);
  EXPECT_EQ(moments[2].camera.eye, camera.eye);
  EXPECT_EQ(moments_of_motions(Scene{}, camera, sun(0, 45), 2).back().time, 0);
}

TEST(Moments, TheSunTurnsEvenly) {
  std::vector<Moment> moments(3);
  turn_sun(moments, {30, 40}, {50, 20});
  EXPECT_LT(glm::distance(moments[0].light.direction, sun(30, 40).direction), 1e-12);
  EXPECT_LT(glm::distance(moments[1].light.direction, sun(40, 30).direction), 1e-12);
  EXPECT_LT(glm::distance(moments[2].light.direction, sun(50, 20).direction), 1e-12);
  EXPECT_LT(glm::distance(sun_angles(sun(-130, 25)), glm::dvec2(-130, 25)), 1e-9);
}

}  // namespace
}  // namespace shadewright
