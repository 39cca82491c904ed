#include "shadewright/raytrace/tracer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace shadewright {
namespace {

// A square of half width `half` at height `y`, facing up.
Mesh square(float half, float y) {
  return {.name = "square",
          .positions = {{-half, y, -half}, {half, y, -half}, {half, y, half}, {-half, y, half}},
          .triangles = {{0, 2, 1}, {0, 3, 2}}};
}

// A 2 x 2 square one metre above a 20 x 20 floor.
Scene square_above_floor() {
  Scene scene;
  scene.meshes = {square(10, 0), square(1, 1)};
  scene.instances.resize(2);
  scene.instances[1].mesh = 1;
  return scene;
}

TEST(Tracer, SquareCastsItsShadowAlongTheSun) {
  const Tracer tracer(square_above_floor());
  const Light light = sun(0, 45);  // towards +X: the shadow is moved by -1 along x
  std::vector<SurfacePoint> points;
  std::vector<uint8_t> expected;
  for (int i = 0; i < 4000; ++i) {
    const float x = -4 + static_cast<float>(i) * 0.002f + 0.001f;
    points.push_back({{x, 0, 0.25f}, {0, 1, 0}});
    expected.push_back(!(x > -2 && x < 0));
  }
  EXPECT_EQ(tracer.visible(points, glm::vec3(0, 5, 0), light), expected);
}

TEST(Tracer, PrimaryHitsTellDepthAndTriangle) {
  const Tracer tracer(square_above_floor());
  PixelGrid grid{.width = 64, .height = 48, .camera = {}};
  grid.camera.eye = {0, 5, 0};
  grid.camera.target = {0, 0, 0};
  const std::vector<PrimaryHit> hits = tracer.primary(grid, 0.01);
  ASSERT_EQ(hits.size(), 64u * 48u);
  const PrimaryHit& center = hits[24 * 64 + 32];
  EXPECT_EQ(center.instance, 1u);
  EXPECT_FLOAT_EQ(center.distance, 4.0f);
  EXPECT_EQ(center.normal, glm::vec3(0, 1, 0));
  EXPECT_EQ(hits[0].instance, 0u);
  EXPECT_FLOAT_EQ(hits[0].distance, 5.0f);
}

}  // namespace
}  // namespace shadewright
