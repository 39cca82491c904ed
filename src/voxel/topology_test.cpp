// Which bodies count as closed.
#include "topology.h"

#include <gtest/gtest.h>

#include "test_scenes.h"

namespace shadewright::voxel {
namespace {

ComponentCounts components_of(const Scene& scene, ClosedMode mode = ClosedMode::automatic) {
  return find_topology(gather_casters(scene), scene, mode).components;
}

Scene scene_of(Mesh mesh) {
  Scene scene;
  add_mesh(scene, std::move(mesh));
  return scene;
}

/// As importers leave it: every triangle with its own corners.
Mesh unwelded(const Mesh& mesh) {
  Mesh result;
  for (const glm::uvec3& t : mesh.triangles) {
    const uint32_t first = uint32_t(result.positions.size());
    for (int i = 0; i < 3; ++i) result.positions.push_back(mesh.positions[t[i]]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

TEST(Topology, FindsClosedBodies) {
  EXPECT_EQ(components_of(scene_of(box_mesh({0, 0, 0}, {1, 2, 3}))).closed, 1u);
  EXPECT_EQ(components_of(scene_of(unwelded(box_mesh({0, 0, 0}, {1, 2, 3})))).closed, 1u);
  std::mt19937 random(3);
  EXPECT_EQ(components_of(scene_of(bumpy_sphere(random, {0, 0, 0}, 1, 0.2f, 8))).closed, 1u);
}

TEST(Topology, OneMissingTriangleOpensABody) {
  Mesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.triangles.pop_back();
  const ComponentCounts counts = components_of(scene_of(mesh));
  EXPECT_EQ(counts.closed, 0u);
  EXPECT_EQ(counts.open, 1u);
}

TEST(Topology, ARoomSeenFromInsideIsOpen) {
  Mesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  const ComponentCounts counts = components_of(scene_of(mesh));
  EXPECT_EQ(counts.inwards, 1u);
  ASSERT_EQ(counts.notes.size(), 1u);
}

TEST(Topology, ABodyAroundTheCameraIsOpen) {
  Scene scene = scene_of(box_mesh({0, 0, 0}, {4, 4, 4}));
  add_mesh(scene, box_mesh({1, 1, 1}, {2, 2, 2}));
  Camera camera;
  camera.eye = {3, 3, 3};
  scene.cameras.push_back(camera);
  const ComponentCounts counts = components_of(scene);
  EXPECT_EQ(counts.inhabited, 1u);
  EXPECT_EQ(counts.closed, 1u);
}

TEST(Topology, MirroredInstancesStayOutward) {
  Scene scene = scene_of(box_mesh({0, 0, 0}, {1, 1, 1}));
  scene.instances[0].world_from_mesh[0][0] = -1;
  EXPECT_EQ(components_of(scene).closed, 1u);
}

TEST(Topology, BoxesThatShareAnEdgeAreClosed) {
  Scene scene = scene_of(box_mesh({0, 0, 0}, {1, 1, 1}));
  add_mesh(scene, box_mesh({1, 1, 0}, {2, 2, 1}));
  const ComponentCounts counts = components_of(scene);
  EXPECT_EQ(counts.closed, 1u);
  EXPECT_EQ(counts.open, 0u);
}

TEST(Topology, TheUserOverrules) {
  const Scene scene = scene_of(box_mesh({0, 0, 0}, {1, 1, 1}));
  const Casters casters = gather_casters(scene);
  for (const uint8_t closed : find_topology(casters, scene, ClosedMode::none).closed) EXPECT_EQ(closed, 0);
  Mesh open = box_mesh({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  const Scene opened = scene_of(open);
  for (const uint8_t closed : find_topology(gather_casters(opened), opened, ClosedMode::all).closed)
    EXPECT_EQ(closed, 1);
}

}  // namespace
}  // namespace shadewright::voxel
