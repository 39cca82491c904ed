// One technique serves lights of changing kinds: its passes are specialized for a kind, its maps have a face or six.
#include "shadow/map_technique.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <numeric>

#include "gpu/device_for_test.h"
#include "shadewright/scene/builtin.h"
#include "shadow/lookup_passes.h"
#include "shadow/parts.h"
#include "shadow/receiver_strips.h"
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

/// A technique is given another scene, at the address of the first one.
TEST_F(MapTechniqueTest, FollowsTheScene) {
  const Scene small = make_builtin("sandbox"), large = make_builtin("chess");
  for (const char* text : {"sm@256", "csm@256", "psm@256", "rtw@256", "spsm@256", "rmsm@4096", "paged@4096,cache=on",
                           "rmsm@4096,draw=superpages"}) {
    const Spec spec = parse_spec(text);
    const auto make = [&] { return make_technique(device(), spec, {width, height}); };
    const auto lasting = make();
    std::optional<ViewForTest> view;
    for (const Scene* scene : {&small, &large, &small}) {
      SCOPED_TRACE(std::string(text) + ", scene " + scene->name);
      view.emplace(device(), *scene, scene->cameras.front(), width, height);
      view->frame().light.direction = glm::normalize(glm::dvec3(0.4, -1, 0.3));
      const auto expected = view->look_up(*make());
      EXPECT_GT(std::ranges::count(expected, std::byte{0}), 100);
      EXPECT_GT(std::ranges::count(expected, std::byte{255}), 100);
      EXPECT_EQ(view->look_up(*lasting), expected);
    }
  }
}

/// What an earlier frame in flight draws from is not destroyed under it.
TEST_F(MapTechniqueTest, FollowsTheSceneWithFramesInFlight) {
  const Scene small = make_builtin("sandbox"), large = make_builtin("chess");
  ViewForTest before(device(), small, small.cameras.front(), width, height);
  ViewForTest after(device(), large, large.cameras.front(), width, height);
  before.frame().light.direction = after.frame().light.direction = glm::normalize(glm::dvec3(0.4, -1, 0.3));
  after.frame().index = 1;
  for (const char* text : {"sm@256", "rtw@256", "spsm@256"}) {
    SCOPED_TRACE(text);
    const auto technique = make_technique(device(), parse_spec(text), {width, height});
    before.look_up(*technique);  // shaders are compiled at their first use
    const vk::raii::CommandPool pool(device().handle(), {{}, device().queue_family()});
    const vk::raii::CommandBuffers buffers(device().handle(), {*pool, vk::CommandBufferLevel::ePrimary, 1});
    const vk::raii::CommandBuffer& commands = buffers.front();
    commands.begin({});
    gpu::Recorder recorder(device(), *commands);
    technique->prepare(before.frame(), recorder);
    technique->record(before.frame(), recorder);
    commands.end();
    device().queue().submit(vk::SubmitInfo({}, {}, *commands));
    const auto found = after.look_up(*technique);
    EXPECT_EQ(found, after.look_up(*make_technique(device(), parse_spec(text), {width, height})));
    device().handle().waitIdle();
  }
}

/// The camera's far plane and a lamp in its sight make the most planes that a view of casters has.
TEST_F(MapTechniqueTest, TakesACameraWithAFarPlane) {
  const Scene scene = make_builtin("sandbox");
  const Camera& camera = scene.cameras.front();
  const double near = near_distance(scene, camera), far = 1000;
  render::CameraView finite = render::make_view(camera, near, width, height);
  const glm::dvec4 depth = glm::row(finite.clip_from_world, 2), w = glm::row(finite.clip_from_world, 3);
  finite.clip_from_world = glm::row(finite.clip_from_world, 2, (far * depth - near * w) / (far - near));
  ASSERT_EQ(finite.planes().size(), 6u);
  Light lamp, spot;
  lamp.kind = LightKind::point;
  spot.kind = LightKind::spot;
  lamp.position = spot.position = glm::mix(camera.eye, camera.target, 0.6);
  spot.direction = {0, -1, 0};
  spot.outer_angle = 1.2;
  for (const Plane& plane : finite.planes()) ASSERT_GT(plane.distance(lamp.position), 0);

  ViewForTest with_far(device(), scene, finite), without(device(), scene, camera, width, height);
  for (const auto& [text, light] :
       {std::pair("sm@256", lamp), {"psm@256", lamp}, {"csm@256", spot}, {"rtw@256", spot}}) {
    SCOPED_TRACE(text);
    with_far.frame().light = without.frame().light = light;
    const Spec spec = parse_spec(text);
    const auto mask = [&](ViewForTest& view) { return view.look_up(*make_technique(device(), spec, {width, height})); };
    const auto found = mask(with_far), expected = mask(without);
    EXPECT_GT(std::ranges::count(expected, std::byte{255}), 100);
    const auto differing =
        std::inner_product(found.begin(), found.end(), expected.begin(), 0, std::plus<>(), std::not_equal_to<>());
    EXPECT_LT(differing, width * height / 100);
  }
}

/// An image that takes two strips of the look-up: what was put off in each is answered in its place. The picture of
/// decisions asks without putting off.
TEST_F(MapTechniqueTest, LooksUpAnImageInStrips) {
  const Scene scene = make_builtin("sandbox");
  constexpr uint32_t side = 2056;
  ASSERT_EQ(receiver_strips(side, side, most_deferred).size(), 2u);
  ViewForTest view(device(), scene, scene.cameras.front(), side, side);
  view.frame().light = scene.lights.front();
  const auto technique = make_technique(device(), parse_spec("spsm@128"), {side, side});
  const auto found = view.look_up(*technique);
  const Picture decisions = technique->debug_picture("decisions");
  size_t wrong = 0, told = 0;
  for (size_t i = 0; i < found.size(); ++i) {
    const glm::u8vec4 color = decisions.pixels[i];
    const int brightest = std::max({color.r, color.g, color.b});
    if (brightest == 20) continue;  // no receiver
    ++told;
    wrong += found[i] != (brightest >= 200 ? std::byte{255} : std::byte{0});
  }
  EXPECT_GT(told, found.size() / 10);
  EXPECT_EQ(wrong, 0u);
}

/// Layers that nothing receives in are undefined: the picture does not show them.
TEST_F(MapTechniqueTest, ShowsNoLayerThatHoldsNothing) {
  const Scene scene = make_builtin("sandbox");
  ViewForTest view(device(), scene, scene.cameras.front(), width, height);
  view.frame().light = Light{};
  view.frame().light.kind = LightKind::point;
  view.frame().light.position = scene.cameras.front().target + glm::dvec3(0.3, 30, 0.2);
  for (const char* text : {"sm@64", "vsm@64", "spsm@64", "rgsm@64"}) {
    SCOPED_TRACE(text);
    const auto technique = make_technique(device(), parse_spec(text), {width, height});
    view.look_up(*technique);
    const Picture picture = technique->debug_picture("shadow-map");
    const std::span pixels(picture.pixels);
    const size_t layer_pixels = 64 * 64;
    size_t drawn = 0;
    for (const MapView& map : technique->views()) {
      drawn += map.drawn;
      const auto layer = pixels.subspan(map.layer * layer_pixels, layer_pixels);
      EXPECT_EQ(std::ranges::any_of(layer, [](const glm::u8vec4& p) { return p.r > 0; }), map.drawn);
    }
    EXPECT_GT(drawn, 0u);
    EXPECT_LT(drawn, 6u);
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
