// All receivers in one plane, across the view, the light or both: they have no depth of their own, against ray tracing.
#include "gpu/device_for_test.h"
#include "shadewright/compare/metrics.h"
#include "shadewright/compare/study.h"

namespace shadewright::shadow {
namespace {

class FlatReceiversTest : public gpu::DeviceTest {};

/// Of a flat box the upper side alone.
void add_box(Scene& scene, const Box& box) {
  const auto corners = box.corners();  // bit 0 of a corner's number is x, bit 1 y, bit 2 z
  Mesh mesh;
  for (const glm::dvec3& corner : corners) mesh.positions.emplace_back(corner);
  mesh.triangles = {{2, 6, 7}, {2, 7, 3}};  // up
  if (box.size().y > 0)
    mesh.triangles.insert(
        mesh.triangles.end(),
        {{0, 1, 5}, {0, 5, 4}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}});
  scene.instances.emplace_back().mesh = static_cast<uint32_t>(scene.meshes.size());
  scene.meshes.push_back(std::move(mesh));
}

TEST_F(FlatReceiversTest, KeepTheirShadows) {
  struct Case {
    const char* name;
    Box caster;
    glm::dvec3 eye;
    Light light;
  };
  const Box roof{{-3, 25, -3}, {3, 26, 3}}, tower{{25.013, 0.1, -3.021}, {27.017, 30.011, 3.033}};
  for (const Case& c : {Case{"across the view and the light", roof, {0, 20, 0}, sun(0, 90)},
                        Case{"across the light", roof, {0, 8, 12}, sun(0, 90)},
                        Case{"across the view", tower, {0, 20, 0}, sun(0, 45)}}) {
    Scene scene;
    add_box(scene, {{-40, 0.1, -40}, {40, 0.1, 40}});
    add_box(scene, c.caster);
    Camera camera;
    camera.eye = c.eye;
    camera.target = {0, 0.1, 0};
    compare::Study study(device(), scene, camera, c.light, {160, 90, 0, 0, true});
    const uint64_t lit = static_cast<uint64_t>(std::ranges::count(study.reference(), uint8_t{1}));
    ASSERT_GT(lit, 1000u);
    ASSERT_LT(lit, 160u * 90u - 500u) << "there is no shadow to lose";
    for (const char* spec : {"sm@512", "uniform@512,fit=visible", "pcf@512", "vsm@512", "cascaded@512", "csm@512",
                             "cascaded@512,splits=sdsm", "cascaded@512,stable=1", "psm@512", "perspective@512,fit=view",
                             "rtw@512", "rmsm@4096", "spsm@512", "rgsm@512"}) {
      const compare::ErrorFigures error = study.run(parse_spec(spec)).result.error;
      EXPECT_LE(error.wrong, error.compared / 100) << c.name << ", " << spec;
      EXPECT_LE(error.oracle_fraction.value_or(0), 5e-4) << c.name << ", " << spec;
    }
  }
}

/// A square across `axis` at `height` along it, of half the side `half`.
void add_square(Scene& scene, int axis, double height, double half) {
  Mesh mesh;
  for (const glm::dvec2& corner : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    glm::dvec3 p;
    p[axis] = height;
    p[(axis + 1) % 3] = half * corner.x;
    p[(axis + 2) % 3] = half * corner.y;
    mesh.positions.emplace_back(p);
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.instances.emplace_back().mesh = static_cast<uint32_t>(scene.meshes.size());
  scene.meshes.push_back(std::move(mesh));
}

TEST_F(FlatReceiversTest, KeepTheShadowsOfWhatIsAsFlat) {
  for (const int axis : {0, 1, 2}) {
    Scene scene;
    add_square(scene, axis, 0, 10);
    add_square(scene, axis, 3, 2);
    const auto place = [&](double along, double u, double v) {
      glm::dvec3 p;
      p[axis] = along;
      p[(axis + 1) % 3] = u;
      p[(axis + 2) % 3] = v;
      return p;
    };
    Camera camera;
    camera.eye = place(1.6, 6, 5);
    camera.target = place(0, 0, 0);
    camera.up = place(1, 0, 0);
    Light light;
    light.position = place(9, 1, -1);
    light.direction = glm::normalize(place(-1, -0.1, 0.1));
    light.outer_angle = 0.8;
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
      light.kind = kind;
      compare::Study study(device(), scene, camera, light, {160, 90, 0, 0, true});
      const auto facing = compare::facing_light(study.points(), light);
      ASSERT_GT(std::ranges::count(facing, uint8_t{1}), std::ranges::count(study.reference(), uint8_t{1}) + 300)
          << "there is no shadow to lose";
      for (const char* spec : {"sm@256", "psm@256", "perspective@256,warp=lispsm"}) {
        const compare::ErrorFigures error = study.run(parse_spec(spec)).result.error;
        EXPECT_LE(error.wrong, error.compared / 50) << "axis " << axis << ", " << spec;
        EXPECT_LE(error.oracle_fraction.value_or(0), 1e-3) << "axis " << axis << ", " << spec;
      }
    }
  }
}

}  // namespace
}  // namespace shadewright::shadow
