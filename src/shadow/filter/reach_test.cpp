// Wide filters at the ends of what a map holds: there they answer what they do anywhere else.
#include "shadow/filter/reach.h"

#include <algorithm>
#include <cmath>

#include "gpu/device_for_test.h"
#include "shadow/view_for_test.h"

namespace shadewright::shadow {
namespace {

constexpr uint32_t width = 160, height = 90;

class FilterReachTest : public gpu::DeviceTest {
 protected:
  /// Open ground 80 m wide and a plate above it.
  static Scene plate_over_ground(const glm::vec2& half, float at_height) {
    Scene scene;
    const auto add = [&](const glm::vec2& size, float y) {
      Mesh mesh;
      mesh.positions = {{-size.x, y, -size.y}, {-size.x, y, size.y}, {size.x, y, size.y}, {size.x, y, -size.y}};
      mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
      scene.instances.emplace_back().mesh = static_cast<uint32_t>(scene.meshes.size());
      scene.meshes.push_back(std::move(mesh));
    };
    add({40, 40}, 0);
    add(half, at_height);
    return scene;
  }
  static Camera looking(const glm::dvec3& eye, const glm::dvec3& target) {
    Camera camera;
    camera.eye = eye;
    camera.target = target;
    return camera;
  }
  std::vector<std::byte> mask(ViewForTest& view, const char* spec, const Light& light) {
    view.frame().light = light;
    return view.look_up(*make_technique(device(), parse_spec(spec), {width, height}));
  }
  /// Pixels that differ by more than a quarter of the light.
  static long differing(const std::vector<std::byte>& a, const std::vector<std::byte>& b) {
    long count = 0;
    for (size_t i = 0; i < a.size(); ++i)
      count += std::abs(std::to_integer<int>(a[i]) - std::to_integer<int>(b[i])) > 64;
    return count;
  }
};

/// What only a penumbra reaches counts as shadowed, and taps stay on the map.
TEST_F(FilterReachTest, PerspectiveMapsHoldPenumbrae) {
  const Scene scene = plate_over_ground({2, 2}, 6);
  ViewForTest view(device(), scene, looking({0, 14, 18}, {0, 0, 0}), width, height);
  const auto uniform = mask(view, "uniform/depth/pcf@512,width=4", sun(0, 90));
  const auto soft = std::ranges::count_if(uniform, [](std::byte v) { return v > std::byte{20} && v < std::byte{235}; });
  EXPECT_GT(soft, 300);
  for (const char* spec : {"perspective/depth/pcf@512,width=4", "perspective/depth/pcf@512,width=4,fit=view",
                           "rectilinear/depth/pcf@512,width=4", "cascaded/depth/pcf@512,width=4"})
    EXPECT_LE(differing(mask(view, spec, sun(0, 90)), uniform), 5) << spec;
}

/// Taps around a receiver at the edge of a point light's face find what lies beyond the edge: as one wide spot does.
TEST_F(FilterReachTest, FacesOverlapByTheFilter) {
  const Scene scene = plate_over_ground({20, 0.5f}, 2);
  ViewForTest view(device(), scene, looking({4.3, 9, 9}, {4.3, 0, 0}), width, height);
  Light lamp, spot;
  lamp.kind = LightKind::point;
  spot.kind = LightKind::spot;
  lamp.position = spot.position = {0.3, 4, 1.2};
  spot.direction = {0, -1, 0};
  spot.outer_angle = 1.45;
  const auto whole = mask(view, "uniform/depth/pcf@2048,width=3", spot);
  EXPECT_GT(std::ranges::count(whole, std::byte{255}), 1000);
  EXPECT_GT(std::ranges::count_if(whole, [](std::byte v) { return v < std::byte{100}; }), 500);
  for (const char* spec : {"uniform/depth/pcf@1024,width=3", "perspective/depth/pcf@1024,width=3"})
    EXPECT_LE(differing(mask(view, spec, lamp), whole), 30) << spec;
}

}  // namespace
}  // namespace shadewright::shadow
