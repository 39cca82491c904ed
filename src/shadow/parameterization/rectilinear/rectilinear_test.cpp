// Truth tests of the warped map: against ray tracing, against the texels' own oracle, and against other ways to draw
// it.
#include <numbers>

#include "gpu/device_for_test.h"
#include "shadewright/compare/study.h"
#include "shadewright/error.h"
#include "shadewright/scene/builtin.h"

namespace shadewright::shadow {
namespace {

class RectilinearTest : public gpu::DeviceTest {
 protected:
  static compare::StudyOptions small() { return {640, 360, 0, 1, true}; }
  static compare::Outcome run(compare::Study& study, const char* spec, std::vector<std::string> debug = {}) {
    return study.run(parse_spec(spec), debug);
  }
  static double wrong(compare::Study& study, const char* spec) {
    return static_cast<double>(run(study, spec).result.error.wrong);
  }
};

/// Adds a box, each side cut into `cuts` x `cuts` squares.
void add_box(Scene& scene, const glm::vec3& center, const glm::vec3& half, uint32_t cuts = 1) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {1.0f, -1.0f}) {
      const auto base = static_cast<uint32_t>(mesh.positions.size());
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (uint32_t j = 0; j <= cuts; ++j)
        for (uint32_t i = 0; i <= cuts; ++i) {
          glm::vec3 p(0);
          p[axis] = sign;
          p[u] = 2.0f * static_cast<float>(i) / static_cast<float>(cuts) - 1.0f;
          p[v] = 2.0f * static_cast<float>(j) / static_cast<float>(cuts) - 1.0f;
          mesh.positions.push_back(p * half);
        }
      for (uint32_t j = 0; j < cuts; ++j)
        for (uint32_t i = 0; i < cuts; ++i) {
          const uint32_t a = base + j * (cuts + 1) + i, b = a + cuts + 1;
          mesh.triangles.emplace_back(a, a + 1, b);
          mesh.triangles.emplace_back(b, a + 1, b + 1);
        }
    }
  scene.instances.push_back({"box", static_cast<uint32_t>(scene.meshes.size()),
                             glm::translate(glm::dmat4(1), glm::dvec3(center)), glm::vec3(0.7f), std::nullopt});
  scene.meshes.push_back(std::move(mesh));
}

/// A floor of `size` metres with a row of pillars that begins beside the camera.
Scene avenue(float size, uint32_t cuts = 1) {
  Scene scene;
  add_box(scene, {0, -0.5f, 0}, {size, 0.5f, size}, cuts);
  for (float distance = 1; distance < 0.9f * size; distance *= 1.5f)
    for (const float side : {-0.5f, 0.7f})
      add_box(scene, {side * distance, 0.4f * distance, -distance},
              {0.03f * distance, 0.4f * distance, 0.03f * distance}, cuts);
  Camera camera;
  camera.eye = {0, 1.2, 1};
  camera.target = {0, 0.3, -4};
  camera.near = 0.05;
  scene.cameras = {camera};
  scene.lights = {sun(25, 30)};
  return scene;
}

TEST_F(RectilinearTest, IsRightUpToItsTexels) {
  for (const char* name : {"sandbox", "city", "chess", "spheres"}) {
    SCOPED_TRACE(name);
    const Scene scene = make_builtin(name);
    compare::Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
    for (const char* spec : {"rtw@512", "rtw@2048", "rtw@2048,collapse=max,px=off,de=on,sn=on,sigma=3"}) {
      SCOPED_TRACE(spec);
      const compare::ErrorFigures error = run(study, spec).result.error;
      ASSERT_GT(error.compared, 20'000u);
      EXPECT_LE(error.oracle_fraction.value_or(1), 5e-4);
      EXPECT_LE(static_cast<double>(error.interior_false_shadow), 1e-4 * static_cast<double>(error.compared));
    }
    EXPECT_GE(run(study, "rectilinear/depth/pcf@2048").result.error.match, 0.99);
    // The same softness as of a uniform map, however the texels lie.
    EXPECT_LE(run(study, "rectilinear/depth/pcf@2048,width=0.02").result.error.mean_absolute,
              1.05 * run(study, "pcf@2048,width=0.02").result.error.mean_absolute + 1e-3);
  }
}

TEST_F(RectilinearTest, BeatsUniformOfTheSameSize) {
  const Scene scene = make_builtin("sandbox");
  compare::Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  const double plain = wrong(study, "sm@1024,fit=visible");
  for (const char* spec :
       {"rtw@1024", "rtw@1024,analysis=hybrid", "rtw@1024,collapse=max,px=off,de=on,sn=on,sigma=3,map=2d",
        "rtw@1024,analysis=hybrid,collapse=max,px=off,de=on,sn=on,sigma=3,map=2d"})
    EXPECT_LT(wrong(study, spec), 0.8 * plain) << spec;
  // Forward analysis is blind to receivers in shadow.
  EXPECT_LT(wrong(study, "rtw@1024,analysis=forward"), 1.2 * plain);
}

TEST_F(RectilinearTest, ImprovesOtherStorages) {
  const Scene scene = make_builtin("lattice");
  compare::Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  const double depth = wrong(study, "rtw@512"), subpixel = wrong(study, "rectilinear/subpixel@512");
  EXPECT_LT(subpixel, 0.5 * depth);
  EXPECT_LT(subpixel, 0.7 * wrong(study, "spsm@512"));
  EXPECT_LT(wrong(study, "rectilinear/triangle@512"), wrong(study, "rgsm@512"));
  EXPECT_LT(wrong(study, "rectilinear/moments/pcf@512"), wrong(study, "vsm@512"));
  EXPECT_THROW(run(study, "rectilinear/subpixel@512,tessellation=off"), InputError);
}

TEST_F(RectilinearTest, KeepsTheNearFieldOfALongView) {
  const Scene scene = avenue(5000);
  compare::Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  const compare::ErrorFigures error = run(study, "rtw@2048").result.error;
  EXPECT_LT(static_cast<double>(error.wrong), 0.1 * wrong(study, "sm@2048,fit=visible"));
  EXPECT_LE(error.oracle_fraction.value_or(1), 5e-4);
}

/// How many texels of a depth picture lie deeper than both their neighbours along an axis.
size_t holes(const Picture& map) {
  const auto value = [&](uint32_t x, uint32_t y) { return int{map.pixels[y * map.width + x].r}; };
  size_t count = 0;
  for (uint32_t y = 1; y + 1 < map.height; ++y)
    for (uint32_t x = 1; x + 1 < map.width; ++x) {
      const int own = value(x, y) + 4;
      count += (own < value(x - 1, y) && own < value(x + 1, y)) || (own < value(x, y - 1) && own < value(x, y + 1));
    }
  return count;
}

/// Finely divided bodies have no crack along the edges that their triangles share, nor where casters are cut.
TEST_F(RectilinearTest, LeavesNoCracks) {
  Scene scene;
  add_box(scene, {0, -0.5f, 0}, {20, 0.5f, 20}, 150);
  add_box(scene, {1, 2, -6}, {2, 2, 2}, 60);
  Camera camera;
  camera.eye = {0, 1.2, 1};
  camera.target = {0, 0.3, -4};
  camera.near = 0.05;
  compare::Study study(device(), scene, camera, sun(25, 30), small());
  for (const char* spec : {"rtw@512", "rtw@512,segments=64", "rtw@512,tessellation=off", "rtw@512,tessellation=1"}) {
    const compare::Outcome outcome = run(study, spec, {"shadow-map"});
    const Picture& map = outcome.debug.front();
    ASSERT_EQ(map.width, 512u);
    ASSERT_GT(std::ranges::count_if(map.pixels, [](const glm::u8vec4& p) { return p.r > 10; }), 100'000) << spec;
    EXPECT_EQ(holes(map), 0u) << spec;
  }
}

/// Large triangles' edges bend in a warped map: cut casters are exact, straight edges are not, short ones less so.
TEST_F(RectilinearTest, BendsLongEdges) {
  const Scene scene = avenue(20);
  compare::Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  const double exact = wrong(study, "rtw@512"), off = wrong(study, "rtw@512,tessellation=off");
  EXPECT_LT(exact, 0.7 * off);
  EXPECT_LT(wrong(study, "rtw@512,tessellation=1"), 0.9 * off);
  // The largest factors, of which many make more vertices than lavapipe keeps apart.
  const Scene boards = make_builtin("sandbox");
  compare::Study large(device(), boards, boards.cameras.front(), boards.lights.front(), small());
  EXPECT_LT(wrong(large, "rtw@512,tessellation=1"), 0.5 * wrong(large, "rtw@512,tessellation=off"));
}

TEST_F(RectilinearTest, FramesWithoutLightWork) {
  const Scene scene = avenue(20);
  Camera sky = scene.cameras.front();
  sky.target = sky.eye + glm::dvec3(0, 1, -0.01);
  // All of the floor under a roof; and lit from below, where all that is seen looks away from the light.
  Scene roofed = scene;
  add_box(roofed, {0, 40, 0}, {200, 0.5f, 200});
  for (const char* spec : {"rtw@512", "rtw@512,analysis=forward", "rtw@512,analysis=hybrid,map=2d"}) {
    SCOPED_TRACE(spec);
    compare::Study nothing(device(), scene, sky, scene.lights.front(), small());
    EXPECT_EQ(run(nothing, spec).result.error.wrong, 0u);
    compare::Study dark(device(), roofed, scene.cameras.front(), scene.lights.front(), small());
    const compare::ErrorFigures error = run(dark, spec).result.error;
    EXPECT_GT(error.compared, 50'000u);
    EXPECT_LE(static_cast<double>(error.wrong), 1e-4 * static_cast<double>(error.compared));
    compare::Study below(device(), scene, scene.cameras.front(), sun(25, -60), small());
    EXPECT_EQ(run(below, spec).result.error.interior_false_shadow, 0u);
  }
}

TEST_F(RectilinearTest, FallsBackToUniform) {
  // From above, every place is as near as any other.
  Scene scene = avenue(20);
  Camera above;
  above.eye = {0.5, 60, -5};
  above.target = {0.5, 0, -5.01};
  above.fov_y = 0.3;
  compare::Study study(device(), scene, above, scene.lights.front(), small());
  EXPECT_LE(wrong(study, "rtw@1024"), 1.05 * wrong(study, "sm@1024,fit=visible") + 20);
}

TEST_F(RectilinearTest, SpotLightInsideTheScene) {
  Scene scene = avenue(10);
  Light lamp;
  lamp.kind = LightKind::spot;
  lamp.position = {0.4, 1.0, -2.5};
  lamp.direction = glm::normalize(glm::dvec3(0.1, -1, -0.4));
  lamp.outer_angle = 1.2;
  compare::Study study(device(), scene, scene.cameras.front(), lamp, small());
  const compare::ErrorFigures error = run(study, "rtw@1024").result.error;
  EXPECT_LE(error.oracle_fraction.value_or(1), 5e-4);
  EXPECT_LE(static_cast<double>(error.wrong), 1.05 * wrong(study, "sm@1024") + 20);
  lamp.kind = LightKind::point;
  EXPECT_THROW(compare::Study(device(), scene, scene.cameras.front(), lamp, small()).run(parse_spec("rtw@512")),
               InputError);
}

TEST_F(RectilinearTest, TellsWhatAUniformMapWouldNeed) {
  const Scene scene = avenue(200);
  compare::Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  const compare::Outcome outcome = run(study, "rtw@2048", {"importance", "warps", "grid"});
  const auto& counters = outcome.result.counters;
  EXPECT_GT(counters.at("effective_resolution")[0] * counters.at("effective_resolution")[1], 4.0 * 2048 * 2048);
  EXPECT_EQ(counters.at("matching_uniform_bytes")[0],
            4.0 * counters.at("effective_resolution")[0] * counters.at("effective_resolution")[1]);
  EXPECT_EQ(outcome.debug.size(), 3u);
}

}  // namespace
}  // namespace shadewright::shadow
