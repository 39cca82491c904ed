// One technique serves lights of changing kinds: its passes are specialized for a kind, its maps have a face or six.
#include "shadow/map_technique.h"

#include <algorithm>
#include <cmath>

#include "gpu/device_for_test.h"
#include "shadewright/scene/builtin.h"
#include "shadow/parts.h"
#include "shadow/view_for_test.h"

namespace shadewright::shadow {
namespace {

constexpr uint32_t width = 97, height = 61;

class MapTechniqueTest : public gpu::DeviceTest {};

TEST_F(MapTechniqueTest, FollowsTheKindOfTheLight) {
  const Scene scene = make_builtin("sandbox");
  ViewForTest view(device(), scene, scene.cameras.front(), width, height);
  Light sun = scene.lights.front(), lamp, spot;
  lamp.kind = LightKind::point;
  lamp.position = scene.cameras.front().target + glm::dvec3(0.3, 1.1, 0.2);
  spot.kind = LightKind::spot;
  spot.position = scene.cameras.front().target + glm::dvec3(2, 6, 1);
  spot.direction = glm::normalize(scene.cameras.front().target - spot.position);
  spot.outer_angle = 0.6;
  for (const char* text :
       {"sm@256", "vsm@256", "psm@256", "rtw@256", "spsm@256", "rgsm@256", "rmsm@4096", "paged@4096,cache=on"}) {
    const Spec spec = parse_spec(text);
    const auto make = [&] { return make_technique(device(), spec, {width, height, 1, true, &scene}); };
    const auto lasting = make();
    for (const Light* light : {&sun, &spot, &lamp, &spot, &sun}) {
      if (!serves(spec.parameterization, light->kind)) continue;
      SCOPED_TRACE(std::string(text) + ", light of kind " + std::to_string(static_cast<int>(light->kind)));
      view.frame().light = *light;
      const auto expected = view.look_up(*make());
      EXPECT_GT(std::ranges::count(expected, std::byte{0}), 100);
      EXPECT_GT(std::ranges::count(expected, std::byte{255}), 100);
      EXPECT_EQ(view.look_up(*lasting), expected);
      ++view.frame().index;
    }
  }
}

/// The oracle asks for the truth where a map holds nothing for a receiver: that it is taken for lit is an error then.
TEST_F(MapTechniqueTest, OracleAsksForReceiversThatTheMapMisses) {
  const Scene scene = make_builtin("sandbox");
  ViewForTest view(device(), scene, scene.cameras.front(), width, height);
  view.frame().light = scene.lights.front();
  Frame nothing = view.frame();
  nothing.scene = nullptr;
  for (const char* text : {"sm@256", "cascaded@256", "rtw@256"}) {
    const auto technique = make_technique(device(), parse_spec(text), {width, height});
    const auto asked = [&](const Frame& frame) {
      gpu::Recorder recorder(device());
      technique->prepare(frame, recorder);
      technique->record(frame, recorder);
      recorder.finish();
      const OracleRays rays = *technique->oracle_rays(frame);
      return std::ranges::count_if(rays.origins, [](const glm::vec3& o) { return std::isfinite(o.x); });
    };
    const auto facing = asked(view.frame());
    EXPECT_GT(facing, 1000) << text;
    EXPECT_EQ(asked(nothing), facing) << text;
  }
}

/// Passes over the camera's buffers take four pixels at once: beyond an image of odd size is nothing. A light of each
/// direction: what a sampler's border holds, if it were taken for a surface, would face some of them.
TEST_F(MapTechniqueTest, SeesNothingBeyondTheImage) {
  const Scene scene = make_builtin("sandbox");
  const Camera camera = scene.cameras.front();
  for (const glm::dvec3 direction : {glm::dvec3(1, -1, 0), {-1, -1, 0}, {0, -1, 1}, {0, -1, -1}}) {
    const auto nearest = [&](uint32_t w, uint32_t h) {
      ViewForTest view(device(), scene, camera, w, h);
      view.frame().light = scene.lights.front();
      view.frame().light.direction = glm::normalize(direction);
      const auto technique = make_technique(device(), parse_spec("psm@256"), {w, h});
      view.look_up(*technique);
      return technique->counters().at("near").front();
    };
    const double even = nearest(128, 96), odd = nearest(129, 97);
    EXPECT_GT(even, 2 * near_distance(scene, camera));
    EXPECT_NEAR(odd / even, 1, 0.1) << direction.x << ' ' << direction.z;
  }
}

}  // namespace
}  // namespace shadewright::shadow
