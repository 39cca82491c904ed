#include <gtest/gtest.h>

#include <algorithm>

#include "scene/load_file.h"
#include "scene/scene_files_for_test.h"
#include "shadewright/geometry/projection.h"

namespace shadewright {
namespace {

Scene write_and_load(const Scene& scene) {
  const TemporaryFolder folder;
  write_glb(scene, folder.file("scene.glb"));
  LoadedScene loaded = load_file(folder.file("scene.glb"));
  EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings.front();
  EXPECT_FALSE(std::filesystem::exists(folder.file("scene.glb.part")));
  return std::move(loaded.scene);
}

void expect_same_geometry(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  ASSERT_EQ(a.instances.size(), b.instances.size());
  EXPECT_EQ(triangle_count(a), triangle_count(b));
  for (const Instance& x : a.instances) {
    const auto y =
        std::find_if(b.instances.begin(), b.instances.end(), [&](const auto& i) { return i.name == x.name; });
    ASSERT_NE(y, b.instances.end()) << x.name;
    const Mesh &mesh_x = a.meshes[x.mesh], &mesh_y = b.meshes[y->mesh];
    EXPECT_EQ(mesh_x.name, mesh_y.name);
    EXPECT_EQ(mesh_x.triangles, mesh_y.triangles);
    EXPECT_EQ(x.albedo, y->albedo);
    EXPECT_EQ(x.motion.has_value(), y->motion.has_value());
    ASSERT_EQ(mesh_x.positions.size(), mesh_y.positions.size());
    for (const double time : {-1.0, 0.0, 0.2, 1.0, 2.0, 9.0})
      for (size_t i = 0; i < mesh_x.positions.size(); ++i)
        expect_near(a.origin + glm::dvec3(transform_at(a, x, time) * glm::dvec4(mesh_x.positions[i], 1)),
                    b.origin + glm::dvec3(transform_at(b, *y, time) * glm::dvec4(mesh_y.positions[i], 1)), 1e-5);
  }
}

void expect_same_view(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.name, b.name);
  expect_near(a.eye, b.eye, 1e-9);
  expect_near(a.target, b.target, 1e-9);
  EXPECT_DOUBLE_EQ(a.fov_y, b.fov_y);
  EXPECT_EQ(a.near, b.near);
  const glm::dmat4 view_a = look_along(a.eye, a.target - a.eye, a.up),
                   view_b = look_along(b.eye, b.target - b.eye, b.up);
  for (int column = 0; column < 3; ++column) expect_near(glm::dvec3(view_a[column]), glm::dvec3(view_b[column]), 1e-9);
}

TEST(WriteGlb, LoadsBackTheSame) {
  const Scene scene = full_scene(), loaded = write_and_load(scene);
  EXPECT_EQ(loaded.name, scene.name);
  expect_same_geometry(scene, loaded);
  ASSERT_EQ(loaded.motions.size(), 1u);
  EXPECT_EQ(loaded.motions[0].name, "swing");
  EXPECT_EQ(loaded.motions[0].times, scene.motions[0].times);
  for (size_t i = 0; i < 3; ++i) {
    expect_near(loaded.motions[0].translations[i], scene.motions[0].translations[i], 1e-6);
    EXPECT_NEAR(std::abs(glm::dot(loaded.motions[0].rotations[i], scene.motions[0].rotations[i])), 1.0, 1e-6);
  }
  ASSERT_EQ(loaded.cameras.size(), 2u);
  for (size_t i = 0; i < 2; ++i) expect_same_view(loaded.cameras[i], scene.cameras[i]);
  EXPECT_EQ(loaded.cameras[0].up, glm::dvec3(0, 1, 0));
  ASSERT_EQ(loaded.lights.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(loaded.lights[i].name, scene.lights[i].name);
    EXPECT_EQ(loaded.lights[i].kind, scene.lights[i].kind);
    expect_near(loaded.lights[i].position, scene.lights[i].position, 1e-9);
    if (scene.lights[i].kind != LightKind::point)
      expect_near(loaded.lights[i].direction, scene.lights[i].direction, 1e-9);
  }
  EXPECT_DOUBLE_EQ(loaded.lights[1].outer_angle, scene.lights[1].outer_angle);
  ASSERT_EQ(loaded.paths.size(), 1u);
  EXPECT_EQ(loaded.paths[0].name, "flight");
  EXPECT_EQ(loaded.paths[0].times, scene.paths[0].times);
  for (size_t i = 0; i < 3; ++i) expect_same_view(loaded.paths[0].keys[i], scene.paths[0].keys[i]);
}

TEST(WriteGlb, KeepsTheOriginFarAway) {
  Scene scene = full_scene();
  scene.origin = {1e6 + 0.125, 0, -3e6};
  const Scene loaded = write_and_load(scene);
  EXPECT_GT(glm::length(loaded.origin), 3e6);
  EXPECT_LT(glm::length(bounds(loaded).center()), 1000.0);
  expect_same_geometry(scene, loaded);
  expect_near(loaded.origin + loaded.cameras[0].eye, scene.origin + scene.cameras[0].eye, 1e-8);
  expect_near(loaded.origin + loaded.paths[0].keys[2].eye, scene.origin + scene.paths[0].keys[2].eye, 1e-8);
}

TEST(WriteGlb, SharesAMeshInTwoColours) {
  Scene scene = full_scene();
  scene.instances[2].albedo = {0.9f, 0.8f, 0.7f};
  expect_same_geometry(scene, write_and_load(scene));
}

TEST(WriteGlb, IsDeterministic) {
  const TemporaryFolder folder;
  write_glb(full_scene(), folder.file("a.glb"));
  write_glb(full_scene(), folder.file("b.glb"));
  EXPECT_EQ(read_text(folder.file("a.glb")), read_text(folder.file("b.glb")));
}

TEST(WriteGlb, FailsInOneSentenceAndLeavesNothing) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_glb(full_scene(), folder.file("missing/scene.glb")), FailureError);
  std::filesystem::create_directory(folder.file("taken"));
  folder.write("taken/file", "x");
  EXPECT_THROW(write_glb(full_scene(), folder.file("taken")), FailureError);
  EXPECT_FALSE(std::filesystem::exists(folder.file("taken.part")));
}

}  // namespace
}  // namespace shadewright
