// Truth tests of cascaded maps and of moments.
#include <algorithm>

#include "gpu/device_for_test.h"
#include "shadewright/compare/study.h"
#include "shadewright/scene/builtin.h"

namespace shadewright::compare {
namespace {

class CascadedStudyTest : public gpu::DeviceTest {
 protected:
  static StudyOptions small() { return {480, 270, 0, 4, true}; }
  static ErrorFigures error_of(Study& study, const char* spec) {
    return study.run(shadow::parse_spec(spec)).result.error;
  }
  static double share(uint64_t pixels, const ErrorFigures& error) {
    return static_cast<double>(pixels) / static_cast<double>(error.compared);
  }
};
using MomentsStudyTest = CascadedStudyTest;

/// Directional and spot lights, every way to split: few wrong pixels, no acne, no detached contacts, and every texel
/// that is asked holds what the oracle says.
TEST_F(CascadedStudyTest, IsRightUpToItsResolution) {
  for (const char* name : {"city", "chess"}) {
    const Scene scene = make_builtin(name);
    Study study(device(), scene, scene.cameras.back(), scene.lights.front(), small());
    const double uniform = error_of(study, "sm@1024").fraction;
    for (const char* spec : {"cascaded@1024", "cascaded@1024,splits=sdsm", "cascaded@1024,stable=1", "cascaded@4096"}) {
      SCOPED_TRACE(std::string(name) + " " + spec);
      const ErrorFigures error = error_of(study, spec);
      EXPECT_LT(error.fraction, uniform);
      EXPECT_LE(*error.oracle_fraction, 5e-4);
      EXPECT_LE(share(error.interior_false_shadow, error), 1e-4);
      if (std::string_view(spec) == "cascaded@4096") {
        EXPECT_LE(share(error.interior_false_lit, error), 1e-4);
      }
    }
    EXPECT_LT(error_of(study, "csm@1024").mean_absolute, error_of(study, "cascaded@1024").mean_absolute);
  }
}

TEST_F(CascadedStudyTest, OneCascadeIsUniform) {
  const Scene scene = make_builtin("sandbox");
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  const double uniform = error_of(study, "sm@1024").fraction,
               one = error_of(study, "cascaded@1024,cascades=1").fraction;
  EXPECT_NEAR(one, uniform, 0.1 * uniform);
}

/// A plane through all cascades has no shadow: neither at the borders of the maps nor between.
TEST_F(CascadedStudyTest, ThePlaneThroughAllCascadesHasNoSeam) {
  Scene scene;
  scene.meshes.push_back(
      {"plane", {{-200, 0, -200}, {200, 0, -200}, {200, 0, 200}, {-200, 0, 200}}, {{0, 2, 1}, {0, 3, 2}}});
  scene.instances.emplace_back().mesh = 0;
  Camera camera;
  camera.eye = {3, 1.7, 150};
  camera.target = {0, 0.5, 100};
  for (const double elevation : {50.0, 4.0}) {
    Study study(device(), scene, camera, sun(20, elevation), small());
    for (const char* spec : {"cascaded@256", "csm@256,radius=7", "csm@512,width=0.5", "csm@256,stable=1,radius=3",
                             "cascaded/depth/pcf@128,splits=sdsm,cascades=8", "cascaded/moments/pcf@256,blur=4"}) {
      const Outcome outcome = study.run(shadow::parse_spec(spec));
      SCOPED_TRACE(std::string(spec) + " elevation " + std::to_string(elevation));
      ASSERT_GE(outcome.result.counters.at("views").front(), 3);
      EXPECT_EQ(outcome.result.error.false_shadow, 0u);
      EXPECT_TRUE(
          std::all_of(outcome.visibility.begin(), outcome.visibility.end(), [](float lit) { return lit > 0.99f; }));
    }
  }
}

TEST_F(CascadedStudyTest, DebugPictureShowsEveryCascadeInSight) {
  const Scene scene = make_builtin("city");
  Study study(device(), scene, find_camera(scene, "street"), scene.lights.front(), small());
  const std::string names[] = {"cascades"};
  const Outcome outcome = study.run(shadow::parse_spec("cascaded@512,splits=sdsm,cascades=3"), names);
  const auto shows = [&](glm::u8vec4 color) {
    const auto& pixels = outcome.debug.at(0).pixels;
    return std::find(pixels.begin(), pixels.end(), color) != pixels.end();
  };
  EXPECT_TRUE(shows({220, 60, 50, 255}));
  EXPECT_TRUE(shows({70, 180, 75, 255}));
  EXPECT_TRUE(shows({65, 100, 220, 255}));
  EXPECT_FALSE(shows({255, 0, 255, 255}));
}

/// Leaks are what moments are known for; acne would be ours.
TEST_F(MomentsStudyTest, ShadowsWithoutAcne) {
  for (const char* name : {"sandbox", "city", "chess"}) {
    const Scene scene = make_builtin(name);
    Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
    for (const char* spec : {"vsm@2048", "uniform/moments/hard@2048", "cascaded/moments/pcf@1024"}) {
      SCOPED_TRACE(std::string(name) + " " + spec);
      const ErrorFigures error = error_of(study, spec);
      EXPECT_GE(error.match, 0.97);
      EXPECT_LE(share(error.interior_false_shadow, error), 1e-4);
      EXPECT_FALSE(error.oracle_fraction.has_value());
    }
    EXPECT_LE(error_of(study, "vsm@2048,bleeding=0.3").false_lit, error_of(study, "vsm@2048").false_lit) << name;
  }
}

TEST_F(MomentsStudyTest, SixFacesHaveNoSeam) {
  const Scene scene = make_builtin("sandbox");
  Light lamp;
  lamp.kind = LightKind::point;
  lamp.position = scene.cameras.front().target + glm::dvec3(0.3, 1.1, 0.2);
  Study study(device(), scene, scene.cameras.front(), lamp, small());
  const ErrorFigures error = error_of(study, "vsm@2048,blur=3");
  EXPECT_GE(error.match, 0.97);
  EXPECT_LE(share(error.interior_false_shadow, error), 1e-4);
}

}  // namespace
}  // namespace shadewright::compare
