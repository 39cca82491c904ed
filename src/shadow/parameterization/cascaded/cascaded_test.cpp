#include "shadow/parameterization/cascaded/cascaded.h"

#include <algorithm>
#include <glm/gtc/matrix_access.hpp>
#include <random>

#include "gpu/device_for_test.h"

namespace shadewright::shadow {
namespace {

render::CameraView view_at(const glm::dvec3& eye, const glm::dvec3& target) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  return render::make_view(camera, 0.05, 320, 200);
}

TEST(SlicesTest, AdjoinAndFillTheRange) {
  for (const double lambda : {0.0, 0.5, 1.0}) {
    const auto slices = split({0.5, 128}, 4, lambda);
    ASSERT_EQ(slices.size(), 4u);
    EXPECT_EQ(slices.front().nearest, 0.5);
    EXPECT_EQ(slices.back().farthest, 128);
    for (size_t i = 1; i < 4; ++i) {
      EXPECT_EQ(slices[i].nearest, slices[i - 1].farthest);
      EXPECT_LT(slices[i].nearest, slices[i].farthest);
    }
  }
  EXPECT_DOUBLE_EQ(split({0.5, 128}, 4, 1)[1].farthest, 8);
  EXPECT_DOUBLE_EQ(split({1, 9}, 4, 0)[1].farthest, 5);
}

class CascadedTest : public gpu::DeviceTest {
 protected:
  static Frame frame_of(const render::CameraView& camera, const Light& light) {
    Frame frame;
    frame.draw_bounds = {{-50, -1, -50}, {50, 6, 50}};
    frame.camera = camera;
    frame.light = light;
    return frame;
  }
  static Light light_of(LightKind kind, const glm::dvec3& direction) {
    Light light;
    light.kind = kind;
    light.direction = glm::normalize(direction);
    light.position = -30.0 * light.direction;
    light.outer_angle = 0.6;
    return light;
  }
};

/// Whatever camera and light, a receiver in sight has a cascade whose map holds it with the filter's footprint.
TEST_F(CascadedTest, EveryReceiverHasACascade) {
  const unsigned seed = 2026;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const char* text :
       {"cascaded@64", "cascaded/depth/pcf@64,radius=7", "cascaded/depth/pcf@512,width=0.4", "csm@22,radius=8",
        "csm@23,radius=8,stable=1", "cascaded/moments/pcf@37,blur=16", "csm@16,width=1000",
        "csm@64,width=1000,stable=1", "cascaded@512,stable=1", "csm@256,stable=1,cascades=8", "csm@64,cascades=1"}) {
    SCOPED_TRACE(text);
    Cascaded cascaded(device(), parse_spec(text), 1);
    int tested = 0;
    for (int round = 0; round < 60; ++round) {
      const auto kind = round % 3 == 0 ? LightKind::spot : LightKind::directional;
      const glm::dvec3 eye(40 * unit(random), 3 + 2 * unit(random), 40 * unit(random));
      const glm::dvec3 target = eye + glm::dvec3(unit(random), 0.5 * unit(random), unit(random));
      const Frame frame =
          frame_of(view_at(eye, target), light_of(kind, {unit(random), -0.2 - std::abs(unit(random)), unit(random)}));
      gpu::Recorder recorder(device());
      cascaded.prepare(frame, recorder);
      const std::vector<glm::vec2> borders = cascaded.borders();
      std::vector<Plane> sight = frame.camera.planes();
      const auto cone = window_planes(light_frames(frame.light).front());
      sight.insert(sight.end(), cone.begin(), cone.end());
      for (int i = 0; i < 200; ++i) {
        const glm::dvec3 receiver = eye + 60 * std::pow(0.5 + 0.5 * unit(random), 3.0) *
                                              frame.camera.ray({160 + 160 * unit(random), 100 + 100 * unit(random)});
        const bool seen = frame.draw_bounds.contains(receiver) &&
                          std::all_of(sight.begin(), sight.end(),
                                      [&](const Plane& plane) { return plane.distance(receiver) > 1e-9; });
        if (!seen) continue;
        ++tested;
        bool held = false;
        for (size_t c = 0; c < cascaded.views().size() && !held; ++c) {
          const MapView& view = cascaded.views()[c];
          const glm::dvec4 q = view.light_from_world * glm::dvec4(receiver, 1);
          const glm::dvec2 room = 1.0 - 2.0 * glm::dvec2(borders[c]);
          held = view.drawn && std::abs(q.x) < room.x * q.w && std::abs(q.y) < room.y * q.w && q.z <= q.w;
        }
        ASSERT_TRUE(held) << "round " << round << ", receiver " << receiver.x << " " << receiver.y << " " << receiver.z;
      }
    }
    EXPECT_GT(tested, 1000);
  }
}

/// A look-up projects a receiver once for all maps, also where it all lies in one plane across the light.
TEST_F(CascadedTest, AllMapsShareOneDepth) {
  for (const double top : {-1.0, 6.0}) {
    Frame frame = frame_of(view_at({3, 5, 2}, {20, -1, 25}), light_of(LightKind::directional, {0, -1, 0}));
    frame.draw_bounds.max.y = top;
    Cascaded cascaded(device(), parse_spec("cascaded@64"), 1);
    gpu::Recorder recorder(device());
    cascaded.prepare(frame, recorder);
    const auto views = cascaded.views();
    ASSERT_TRUE(std::ranges::all_of(views, [](const MapView& view) { return view.drawn; }));
    for (const MapView& view : views)
      EXPECT_EQ(glm::row(view.light_from_world, 2), glm::row(views.front().light_from_world, 2)) << "up to " << top;
  }
}

/// stable=1: between frames of a moving camera, a map's texels keep their size and their places in the world.
TEST_F(CascadedTest, StableMapsMoveByWholeTexels) {
  const unsigned seed = 8;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const auto kind : {LightKind::directional, LightKind::spot}) {
    Cascaded cascaded(device(), parse_spec("cascaded@512,stable=1"), 1);
    const Light light = light_of(kind, {0.4, -1, 0.3});
    glm::dvec3 eye(0, 3, 0), ahead(0.2, -0.2, 1);
    std::vector<MapView> before;
    int moved = 0, same_size = 0, compared = 0;
    for (int step = 0; step < 100; ++step) {
      eye += 0.05 * glm::dvec3(unit(random), 0.1 * unit(random), unit(random));
      ahead += 0.02 * glm::dvec3(unit(random), 0.1 * unit(random), unit(random));
      gpu::Recorder recorder(device());
      cascaded.prepare(frame_of(view_at(eye, eye + ahead), light), recorder);
      const auto views = cascaded.views();
      for (size_t c = 0; c < before.size(); ++c) {
        if (!before[c].drawn || !views[c].drawn) continue;
        ++compared;
        const auto texels = [&](const MapView& view, const glm::dvec3& p) {
          const glm::dvec4 q = view.light_from_world * glm::dvec4(p, 1);
          return 256.0 * glm::dvec2(q) / q.w;
        };
        const glm::dvec3 a(3, 0, 7), b(-2, 1, 12);
        const glm::dvec2 span_before = texels(before[c], b) - texels(before[c], a),
                         span = texels(views[c], b) - texels(views[c], a);
        if (glm::length(span - span_before) > 1e-6) continue;  // a window chosen anew
        ++same_size;
        const glm::dvec2 shift = texels(views[c], a) - texels(before[c], a);
        moved += glm::length(shift) > 0.5;
        EXPECT_LT(glm::length(shift - glm::round(shift)), 1e-6) << "step " << step << " cascade " << c;
      }
      before.assign(views.begin(), views.end());
    }
    EXPECT_GT(compared, 100);
    EXPECT_GT(same_size, 0.9 * compared);
    EXPECT_GT(moved, 20);
  }
}

/// And they never become much larger than what a fitted map must hold, wherever the camera has been before: 1.4 times
/// the area, of a slice of as much too large a range.
TEST_F(CascadedTest, StableMapsStayNearlyFitted) {
  const Light light = light_of(LightKind::directional, {0.4, -1, 0.3});
  Cascaded stable(device(), parse_spec("cascaded@512,stable=1"), 1), fitted(device(), parse_spec("cascaded@512"), 1);
  for (int step = 0; step < 60; ++step) {
    const double turn = 0.35 * step, height = 2 + 20 * (step % 7 == 0);
    const glm::dvec3 eye(30 * std::cos(turn), height, 20 * std::sin(1.7 * turn));
    const Frame frame = frame_of(view_at(eye, eye + glm::dvec3(std::sin(turn), -0.3, std::cos(turn))), light);
    gpu::Recorder recorder(device());
    stable.prepare(frame, recorder);
    fitted.prepare(frame, recorder);
    for (size_t c = 0; c < 4; ++c) {
      const MapView &held = stable.views()[c], &fit = fitted.views()[c];
      ASSERT_EQ(held.drawn, fit.drawn);
      const auto per_texel = [](const MapView& view) {
        return 1 / glm::length(glm::cross(glm::dvec3(glm::row(view.light_from_world, 0)),
                                          glm::dvec3(glm::row(view.light_from_world, 1))));
      };
      if (held.drawn) {
        EXPECT_LT(per_texel(held), 2 * per_texel(fit)) << "step " << step << " cascade " << c;
      }
    }
  }
}

TEST_F(CascadedTest, SkipsCascadesWithoutReceivers) {
  Cascaded cascaded(device(), parse_spec("cascaded@64"), 1);
  Frame frame = frame_of(view_at({0, 100, 0}, {0, 200, 1}), light_of(LightKind::directional, {0, -1, 0}));
  gpu::Recorder recorder(device());
  cascaded.prepare(frame, recorder);
  for (const MapView& view : cascaded.views()) EXPECT_FALSE(view.drawn);
}

}  // namespace
}  // namespace shadewright::shadow
