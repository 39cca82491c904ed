#include "shadow/parameterization/uniform/fit.h"

#include <gtest/gtest.h>

#include <random>

namespace shadewright::shadow {
namespace {

/// Random cameras and lights around a box of receivers: every receiver that the light can see falls inside the map.
class FitTest : public testing::TestWithParam<LightKind> {};

TEST_P(FitTest, HoldsEveryReceiver) {
  const unsigned seed = 20260;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto point = [&](double scale) { return scale * glm::dvec3(unit(random), unit(random), unit(random)); };
  int tested = 0;
  for (int round = 0; round < 200; ++round) {
    Frame frame;
    frame.draw_bounds = {{-5, -1, -5}, {5, 2, 5}};
    Camera camera;
    camera.eye = point(10);
    camera.target = point(3);
    frame.camera = render::make_view(camera, 0.05, 320, 200);
    frame.light.kind = GetParam();
    frame.light.position = point(8);
    frame.light.direction = glm::normalize(point(1));
    frame.light.outer_angle = 0.3 + 0.5 * (unit(random) + 1);
    const auto camera_planes = frame.camera.planes();
    for (const LightFrame& light : light_frames(frame.light)) {
      auto planes = window_planes(light);
      const auto window = planes;
      planes.insert(planes.end(), camera_planes.begin(), camera_planes.end());
      const auto points = receiver_points(frame, planes);
      const LightFrame turned = turn_to_fit(light, points);
      const MapView view = fit_view(turned, receiver_bounds(turned, points), 1024, {});
      for (int i = 0; i < 50; ++i) {
        const glm::dvec3 receiver(5 * unit(random), 0.5 + 1.5 * unit(random), 5 * unit(random));
        const auto inside = [&](const std::vector<Plane>& list) {
          return std::all_of(list.begin(), list.end(),
                             [&](const Plane& plane) { return plane.distance(receiver) > 1e-9; });
        };
        if (!inside(camera_planes) || !inside(window)) continue;
        ++tested;
        ASSERT_TRUE(view.drawn);
        const glm::dvec4 q = view.light_from_world * glm::dvec4(receiver, 1);
        ASSERT_GT(q.w, 0);
        ASSERT_LE(std::abs(q.x), q.w);
        ASSERT_LE(std::abs(q.y), q.w);
        ASSERT_LE(q.z, q.w);
        // Nearer than 1e-4 of the farthest receiver a lamp's depth is clamped.
        if (q.w > 1e-2 || !light.perspective) {
          ASSERT_GE(q.z, 0);
        }
        // Casters on the way to the light are never culled.
        const glm::dvec3 to_light = light.perspective ? frame.light.position - receiver : -3.0 * frame.light.direction;
        for (const Plane& plane : caster_planes(view, frame.camera, frame.light, true, {}))
          for (const double t : {0.0, 0.3, 0.999}) ASSERT_GE(plane.distance(receiver + t * to_light), -1e-6);
      }
    }
  }
  EXPECT_GT(tested, 1000);
}

INSTANTIATE_TEST_SUITE_P(Lights, FitTest, testing::Values(LightKind::directional, LightKind::spot, LightKind::point));

TEST(FitTest, TurnsTheMapToADiagonalStrip) {
  LightFrame light;
  std::vector<glm::dvec3> strip;
  for (const double along : {-10.0, 10.0})
    for (const double across : {-1.0, 1.0}) strip.emplace_back(along + across, along - across, 0);
  const Box plain = receiver_bounds(light, strip), turned = receiver_bounds(turn_to_fit(light, strip), strip);
  EXPECT_LT(turned.size().x * turned.size().y, 0.2 * plain.size().x * plain.size().y);
}

TEST(FitTest, NoReceiversIsAViewThatIsNotDrawn) {
  EXPECT_FALSE(fit_view(LightFrame{}, receiver_bounds(LightFrame{}, {}), 512, {}).drawn);
}

}  // namespace
}  // namespace shadewright::shadow
