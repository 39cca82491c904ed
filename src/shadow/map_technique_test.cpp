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
  Camera camera = scene.cameras.front();
  ViewForTest seen(device(), scene, camera, width, height);
  camera.eye += 3.0 * (camera.eye - camera.target);  // sees more than the map holds
  camera.target += glm::dvec3(3, 0, 3);
  ViewForTest more(device(), scene, camera, width, height);
  seen.frame().light = more.frame().light = scene.lights.front();
  const auto technique = make_technique(device(), parse_spec("uniform@256,fit=visible"), {width, height});
  seen.look_up(*technique);
  const OracleRays rays = *technique->oracle_rays(more.frame());
  size_t held = 0, missed = 0;
  for (size_t i = 0; i < rays.origins.size(); ++i) {
    if (!std::isfinite(rays.origins[i].x)) continue;  // averted, or no surface
    ++(rays.texel_u[i] == glm::vec3(0) ? missed : held);
  }
  EXPECT_GT(held, 100u);
  EXPECT_GT(missed, 100u);
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
