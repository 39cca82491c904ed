// Facades seen from afar, whose ledges are smaller than texels, against ray tracing.
#include "gpu/device_for_test.h"
#include "shadewright/compare/study.h"

namespace shadewright::shadow {
namespace {

class SubpixelFacadeTest : public gpu::DeviceTest {};

/// A wall of one surface that looks along +X, 12 m high and 20 m wide, with ledges all over it, and open ground before
/// it. In metres.
Scene facade(float ledge_out, float ledge_height, float ledge_distance, uint32_t pieces) {
  const float height = 12, half_width = 10;
  std::vector<glm::vec2> profile{{0, 0}};
  for (float y = ledge_distance; y + ledge_height < height; y += ledge_distance)
    profile.insert(profile.end(), {{0, y}, {ledge_out, y}, {ledge_out, y + ledge_height}, {0, y + ledge_height}});
  profile.emplace_back(0, height);
  Mesh mesh;
  const auto row = static_cast<uint32_t>(profile.size());
  for (uint32_t piece = 0; piece <= pieces; ++piece) {
    const float z = half_width * (2 * static_cast<float>(piece) / static_cast<float>(pieces) - 1);
    for (const glm::vec2& p : profile) mesh.positions.emplace_back(p, z);
    if (piece == pieces) break;
    for (uint32_t i = piece * row; i + 1 < (piece + 1) * row; ++i) {
      mesh.triangles.emplace_back(i, i + 1, i + row + 1);
      mesh.triangles.emplace_back(i, i + row + 1, i + row);
    }
  }
  const auto ground = static_cast<uint32_t>(mesh.positions.size());
  for (const glm::vec2& p : {glm::vec2(-2, -20), {20, -20}, {20, 20}, {-2, 20}})
    mesh.positions.emplace_back(p.x, 0, p.y);
  mesh.triangles.emplace_back(ground, ground + 2, ground + 1);
  mesh.triangles.emplace_back(ground, ground + 3, ground + 2);
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  scene.instances.emplace_back();
  return scene;
}

/// What goes on beyond an edge of a ledge is the wall, which passes through the receiver's plane before it would cover
/// the receiver: no shadow from that.
TEST_F(SubpixelFacadeTest, LedgesSmallerThanTexelsCastNoFalseShadows) {
  Camera camera;
  camera.eye = {7.6, 11.7, 9.5};
  camera.target = {0, 6, 0};
  for (const Scene& scene : {facade(0.05f, 0.1f, 0.6f, 1), facade(0.02f, 0.04f, 0.4f, 40)}) {
    uint64_t plain = 0, wrong = 0, false_shadow = 0;
    for (const Light& light : {sun(35, 45), sun(60, 30), sun(10, 60)}) {
      compare::Study study(device(), scene, camera, light, {320, 180, 0, 0, true});
      const compare::ErrorFigures fine = study.run(parse_spec("spsm@128")).result.error;
      plain += study.run(parse_spec("sm@128")).result.error.wrong;
      wrong += fine.wrong;
      false_shadow += fine.false_shadow;
    }
    EXPECT_LE(wrong, plain);
    EXPECT_LE(4 * false_shadow, plain);
  }
}

}  // namespace
}  // namespace shadewright::shadow
