// Truth tests: what is drawn on the device against ray tracing, and what a Study reports.
#include "shadewright/compare/study.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "compare/study/pair_errors_for_test.h"

#include "gpu/device_for_test.h"
#include "shadewright/geometry/projection.h"
#include "shadewright/scene/builtin.h"
#include "shadewright/scene/points.h"
#include "shadow/parameterization/perspective/random_pairs_for_test.h"

namespace shadewright::compare {
namespace {

class StudyTest : public gpu::DeviceTest {
 protected:
  static StudyOptions small() { return {640, 360, 0, 4, true}; }
  static Outcome run(Study& study, const char* spec) { return study.run(shadow::parse_spec(spec)); }
};

/// Sharp maps: few wrong pixels, no acne, no detached contacts, and the texel that is asked holds what the oracle says.
TEST_F(StudyTest, HardMapsAreRightUpToTheirResolution) {
  for (const char* name : {"sandbox", "city", "chess", "spheres"}) {
    const Scene scene = make_builtin(name);
    Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
    double fraction = 1;
    for (const char* spec : {"sm@1024", "sm@2048", "sm@4096"}) {
      const ErrorFigures error = run(study, spec).result.error;
      SCOPED_TRACE(std::string(name) + " " + spec);
      ASSERT_GT(error.compared, 20'000u);
      EXPECT_LT(error.fraction, fraction);
      ASSERT_TRUE(error.oracle_fraction.has_value());
      EXPECT_LE(*error.oracle_fraction, 5e-4);
      EXPECT_LE(static_cast<double>(error.interior_false_shadow), 1e-4 * static_cast<double>(error.compared));
      fraction = error.fraction;
    }
    const ErrorFigures finest = run(study, "sm@4096").result.error;
    EXPECT_GE(finest.match, 0.99) << name;
    EXPECT_LE(static_cast<double>(finest.interior_false_lit), 1e-4 * static_cast<double>(finest.compared)) << name;
  }
}

/// Where leaves' edges are as close as texels, the rasterizer's snapping of vertices to 1/256 texel decides more pixels
/// than elsewhere: that is all by which the map differs from the oracle.
TEST_F(StudyTest, AmongLeavesMapsDifferFromTheOracleBySnappingOnly) {
  const Scene scene = make_builtin("ecosystem?triangles=1e6");
  PairErrors errors(device(), scene, 320, 180, {"sm@512", "sm@2048"});
  Camera camera = scene.cameras.front();
  camera.near = near_distance(scene, camera);
  for (const PairErrors::Result& result : errors.run(camera, scene.lights.front())) {
    EXPECT_GT(result.error.compared, 20'000u);
    EXPECT_LE(*result.error.oracle_fraction, 4e-3);
    EXPECT_EQ(result.beyond_snapping, 0u);
  }
}

/// Sub-pixel maps: far fewer wrong pixels than depths of the same resolution, and no acne.
TEST_F(StudyTest, SubPixelMapsPlaceEdgesWithinTexels) {
  for (const char* name : {"spheres", "chess", "lattice"}) {
    SCOPED_TRACE(name);
    const Scene scene = make_builtin(name);
    Study study(device(), scene, scene.cameras.back(), scene.lights.front(), small());
    const ErrorFigures plain = run(study, "sm@1024").result.error, fine = run(study, "spsm@1024").result.error;
    EXPECT_LE(4 * fine.wrong, plain.wrong);
    EXPECT_LE(static_cast<double>(fine.interior_false_shadow), 1e-4 * static_cast<double>(fine.compared));
    const ErrorFigures by_tangents = run(study, "spsm@1024,recovery=tangents").result.error;
    EXPECT_LE(fine.wrong, by_tangents.wrong);
    EXPECT_LE(2 * by_tangents.wrong, plain.wrong);
  }
}

/// Where bodies are thinner than texels and lie in many layers, most of what covers a receiver is not kept: no lit
/// specks for all that.
TEST_F(StudyTest, SubPixelShadowsOfClutterHaveNoLitSpecks) {
  for (const auto& [name, camera] : {std::pair("furball", "wall"), {"playground", "main"}, {"trees", "wide"}}) {
    const Scene scene = make_builtin(name);
    Study study(device(), scene, find_camera(scene, camera), scene.lights.front(), {320, 180, 0, 0, true});
    for (const char* spec : {"spsm@2048", "perspective/subpixel@1024"}) {
      SCOPED_TRACE(std::string(name) + " " + spec);
      const ErrorFigures error = run(study, spec).result.error;
      EXPECT_LE(error.interior_false_lit, 4u);
      EXPECT_LE(error.false_lit, error.false_shadow);
    }
  }
}

/// The border that one look-up found serves the whole pixel, and pixels tell how they were decided.
TEST_F(StudyTest, SubPixelMapsSmoothTheirEdges) {
  const Scene scene = make_builtin("spheres");
  Study study(device(), scene, scene.cameras.back(), scene.lights.front(), small());
  const std::string names[] = {"decisions"};
  const Outcome hard = study.run(shadow::parse_spec("spsm@1024"), names);
  EXPECT_LE(run(study, "uniform/subpixel/aa@1024").result.error.mean_absolute, 0.7 * hard.result.error.mean_absolute);
  double decided = 0;
  for (const char* way : {"decided_by_one_texel", "decided_by_neighbours", "decided_by_recovery"}) {
    EXPECT_GT(hard.result.counters.at(way).front(), 0) << way;
    decided += hard.result.counters.at(way).front();
  }
  EXPECT_NEAR(decided, static_cast<double>(hard.result.error.compared), 1e-3 * decided);
  ASSERT_EQ(hard.debug.size(), 1u);
  const auto red = std::count_if(hard.debug[0].pixels.begin(), hard.debug[0].pixels.end(),
                                 [](const auto& pixel) { return pixel.r > 2 * pixel.g; });
  EXPECT_GT(red, 0);
  EXPECT_LE(static_cast<double>(red), hard.result.counters.at("decided_by_recovery").front());
}

TEST_F(StudyTest, PointLightsHaveSixFaces) {
  Scene scene = make_builtin("sandbox");
  Light lamp;
  lamp.kind = LightKind::point;
  lamp.position = scene.cameras.front().target + glm::dvec3(0.3, 1.1, 0.2);
  Study study(device(), scene, scene.cameras.front(), lamp, small());
  const Outcome outcome = run(study, "sm@2048");
  EXPECT_GT(outcome.result.counters.at("views").front(), 1);
  EXPECT_LE(*outcome.result.error.oracle_fraction, 5e-4);
  EXPECT_GE(outcome.result.error.match, 0.98);
  EXPECT_GE(run(study, "pcf@2048").result.error.match, 0.98);
}

/// Far instances as points: image, map and truth show the same splats, and nearly the same shadows as triangles.
TEST_F(StudyTest, PointsAreTheSameToTheMapAndTheTruth) {
  for (const char* name : {"spheres", "trees"}) {
    SCOPED_TRACE(name);
    const Scene scene = make_builtin(name);
    const Camera& camera = scene.cameras.front();
    const PointView view = point_view(camera, small().height);
    PointSummary summary;
    const Scene splats = with_points(scene, std::span(&view, 1), {.spacing = 4, .most_splats = 4}, &summary);
    ASSERT_GT(summary.instances, 10u);
    Study study(device(), splats, camera, scene.lights.front(), small());
    const ErrorFigures error = run(study, "sm@2048").result.error;
    EXPECT_LE(*error.oracle_fraction, 5e-4);
    EXPECT_LE(static_cast<double>(error.interior_false_shadow), 1e-4 * static_cast<double>(error.compared));
    EXPECT_NEAR(study.report().reference_lit_fraction,
                Study(device(), scene, camera, scene.lights.front(), small()).report().reference_lit_fraction, 0.03);
  }
}

TEST_F(StudyTest, PerspectiveHalvesTheErrorsOfAStreet) {
  const Scene scene = make_builtin("street");
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  for (const char* resolution : {"512", "1024"}) {
    const auto error = [&](const std::string& spec) { return run(study, (spec + resolution).c_str()).result.error; };
    const ErrorFigures uniform = error("sm@"), perspective = error("psm@");
    EXPECT_LE(2 * perspective.wrong, uniform.wrong);
    EXPECT_LE(*perspective.oracle_fraction, 5e-4);
    // Pixels at a wall's own edge, whose texel's centre lies beyond it: uniform maps have them too, no acne.
    EXPECT_LE(perspective.interior_false_shadow, 4u);
  }
  for (const char* spec : {"psm@512,warp=lispsm", "psm@512,warp=psm,shift=least", "psm@512,fit=view"}) {
    const Outcome outcome = run(study, spec);
    EXPECT_LE(*outcome.result.error.oracle_fraction, 5e-4) << spec;
    EXPECT_LT(outcome.result.error.wrong, run(study, "sm@512").result.error.wrong) << spec;
  }
}

/// A few of the pairs that benchmarks/psm_random_pairs runs by the thousand.
TEST_F(StudyTest, PerspectiveIsRightForRandomCamerasAndLights) {
  const Scene scene = make_builtin("spheres");
  constexpr unsigned seed = 9;
  SCOPED_TRACE("seed " + std::to_string(seed));
  PairErrors errors(device(), scene, 160, 120, {"sm@128", "psm@128"});
  shadow::RandomPairs pairs(bounds(scene), seed);
  uint64_t compared = 0, wrong = 0, wrong_uniform = 0;
  double oracle = 0;
  for (int i = 0; i < 12; ++i) {
    SCOPED_TRACE("pair " + std::to_string(i));
    const auto [camera, light] = pairs.next();
    const auto results = errors.run(camera, light);
    const ErrorFigures &uniform = results[0].error, &perspective = results[1].error;
    compared += perspective.compared;
    wrong += perspective.wrong;
    wrong_uniform += uniform.wrong;
    oracle += *perspective.oracle_fraction * static_cast<double>(perspective.compared);
    // Ten pixels more, since few wrong pixels are a matter of where texels' centres happen to lie.
    EXPECT_LE(static_cast<double>(perspective.wrong), 1.25 * static_cast<double>(uniform.wrong) + 10);
  }
  EXPECT_LE(oracle, 5e-4 * static_cast<double>(compared));
  EXPECT_LT(wrong, wrong_uniform);
}

TEST_F(StudyTest, PerspectiveSurvivesTheSkyAndLightFromBehindAndBefore) {
  const Scene scene = make_builtin("spheres");
  Camera camera = scene.cameras.front();
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  for (const double sign : {1.0, -1.0}) {
    Light light = scene.lights.front();
    light.kind = LightKind::directional;
    light.direction = sign * forward;
    Study study(device(), scene, camera, light, {160, 90, 0, 1, true});
    EXPECT_LE(*run(study, "psm@512").result.error.oracle_fraction, 2e-3);
  }
  camera.target = camera.eye + glm::dvec3(0, 5, 0.1);
  Study sky(device(), scene, camera, scene.lights.front(), {160, 90, 0, 1, true});
  EXPECT_EQ(run(sky, "psm@512").result.error.wrong, 0u);
}

TEST_F(StudyTest, EveryFitHoldsWhatIsSeen) {
  const Scene scene = make_builtin("city");
  Study study(device(), scene, scene.cameras.back(), scene.lights.front(), small());
  const double scene_fit = run(study, "sm@1024,fit=scene").result.error.fraction;
  const double view_fit = run(study, "sm@1024,fit=view").result.error.fraction;
  const ErrorFigures visible = run(study, "sm@1024,fit=visible").result.error;
  EXPECT_LE(view_fit, 1.05 * scene_fit);
  EXPECT_LE(visible.fraction, 1.05 * view_fit);
  EXPECT_LE(*visible.oracle_fraction, 5e-4);
}

TEST_F(StudyTest, FilteringLowersTheErrorAgainstTheFilteredTruth) {
  const Scene scene = make_builtin("spheres");
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  const ErrorFigures hard = run(study, "sm@1024").result.error, soft = run(study, "pcf@1024").result.error;
  EXPECT_LT(soft.mean_absolute, hard.mean_absolute);
  EXPECT_FALSE(soft.oracle_fraction.has_value());
}

/// A constant width in metres means the same penumbra from maps of any resolution.
TEST_F(StudyTest, WorldWidthDoesNotFollowTheResolution) {
  const Scene scene = make_builtin("sandbox");
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  const auto difference = [&](const char* a, const char* b) {
    const auto first = run(study, a).visibility, second = run(study, b).visibility;
    double sum = 0;
    for (size_t i = 0; i < first.size(); ++i)
      sum += std::abs(static_cast<double>(first[i]) - static_cast<double>(second[i]));
    return sum / static_cast<double>(first.size());
  };
  EXPECT_LT(difference("pcf@2048,width=0.03", "pcf@4096,width=0.03"),
            0.5 * difference("pcf@512,radius=4", "pcf@4096,radius=4"));
}

TEST_F(StudyTest, FarFromTheOriginAndTinyScenesStayRight) {
  for (const double scale : {1e-3, 1e4}) {
    Scene scene = make_builtin("spheres");
    const glm::dmat4 scaling = glm::dmat4(glm::dmat3(scale));
    for (Instance& instance : scene.instances) instance.world_from_mesh = scaling * instance.world_from_mesh;
    Camera camera = scene.cameras.front();
    camera.eye *= scale;
    camera.target *= scale;
    camera.near *= scale;
    Study study(device(), scene, camera, scene.lights.front(), small());
    const ErrorFigures error = run(study, "sm@2048").result.error;
    EXPECT_GE(error.match, 0.99) << scale;
    EXPECT_LE(*error.oracle_fraction, 5e-4) << scale;
  }
}

TEST_F(StudyTest, TheReferenceIsItsOwnTruth) {
  const Scene scene = make_builtin("spheres");
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  EXPECT_EQ(run(study, "ray").result.error.wrong, 0u);
}

TEST_F(StudyTest, TheSameFrameTwiceIsTheSameBytes) {
  const Scene scene = make_builtin("city");
  Study first(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  Study second(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  for (const char* spec : {"sm@1024", "pcf@1024"}) EXPECT_EQ(run(first, spec).visibility, run(second, spec).visibility);
}

TEST_F(StudyTest, ALightFromBelowLeavesNothingLit) {
  const Scene scene = make_builtin("spheres");
  Study study(device(), scene, scene.cameras.front(), sun(0, -80), small());
  EXPECT_GE(run(study, "sm@1024").result.error.match, 0.98);
}

TEST_F(StudyTest, TellsPlacesInTheFilesCoordinates) {
  Scene scene = make_builtin("chess");
  scene.origin = {4.5e6, 100, 5e5};
  const Camera& camera = scene.cameras.front();
  const Light& light = scene.lights.front();
  const Study study(device(), scene, camera, light, small());
  EXPECT_EQ(study.report().camera.eye, camera.eye + scene.origin);
  EXPECT_EQ(study.report().camera.target, camera.target + scene.origin);
  EXPECT_EQ(study.report().light.position, light.position + scene.origin);
}

TEST_F(StudyTest, TakesTheDebugImagesThatATechniqueHas) {
  const Scene scene = make_builtin("spheres");
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  const std::vector<std::string> names{"cascades", "shadow-map"};
  const Outcome sm = study.run(shadow::parse_spec("sm@256"), names), ray = study.run(shadow::parse_spec("ray"), names);
  ASSERT_EQ(sm.debug.size(), 2u);
  EXPECT_TRUE(sm.debug[0].pixels.empty());
  EXPECT_FALSE(sm.debug[1].pixels.empty());
  EXPECT_EQ(ray.debug.size(), 2u);
}

TEST_F(StudyTest, TakesTurnsWithFramesInFlightAndKindsOfLight) {
  const Scene scene = make_builtin("spheres");
  const render::SceneGpu scene_gpu(device(), scene);
  const Camera& camera = scene.cameras.front();
  render::CameraPass camera_pass(scene_gpu, 320, 180, false);
  shadow::Frame frame;
  frame.scene = &scene_gpu;
  frame.camera = render::make_view(camera, near_distance(scene, camera), 320, 180);
  frame.light = scene.lights.front();
  {
    gpu::Recorder recorder(device());
    camera_pass.record(recorder, frame.camera);
    recorder.finish();
  }
  frame.depth = camera_pass.depth().view();
  frame.normal = camera_pass.normal().view();
  const auto technique = shadow::make_technique(device(), shadow::parse_spec("sm@512"), {320, 180, 2, true});
  Light lamp = frame.light;
  lamp.kind = LightKind::point;
  lamp.position = camera.target + glm::dvec3(0, 5, 0);
  std::vector<std::vector<std::byte>> masks;
  for (uint64_t i = 0; i < 4; ++i) {
    frame.index = i;
    if (i == 3) frame.light = lamp;
    gpu::Recorder recorder(device());
    technique->prepare(frame, recorder);
    // The last but one goes into a command buffer of the caller's.
    if (i == 2) {
      recorder.finish();
      gpu::submit_and_wait(device(), [&](const auto& commands) { technique->record(frame, *commands); });
    } else {
      technique->record(frame, recorder);
      recorder.finish();
    }
    masks.push_back(gpu::read_back(device(), technique->visibility(), 1));
  }
  EXPECT_EQ(masks[0], masks[1]);
  EXPECT_EQ(masks[0], masks[2]);
  EXPECT_NE(masks[0], masks[3]);
}

TEST_F(StudyTest, WritesTheWholeReport) {
  const Scene scene = make_builtin("spheres");
  StudyOptions options = small();
  options.width = 160;
  options.height = 90;
  options.repeat = 2;
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), options);
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "shadewright-study-test";
  std::filesystem::remove_all(folder);
  const std::vector<shadow::Spec> specs{shadow::parse_spec("sm@512"), shadow::parse_spec("pcf@512"),
                                        shadow::parse_spec("sm@512")};
  const Report report = compare_techniques(study, specs, folder);
  ASSERT_EQ(report.results.size(), 3u);
  EXPECT_NE(report.results[0].image, report.results[2].image);
  for (const auto& result : report.results) {
    EXPECT_GT(result.milliseconds.median, 0);
    EXPECT_GE(result.frame_milliseconds, result.milliseconds.median);
    EXPECT_GT(result.memory_bytes(), 512u * 512u * 4u);
    for (const std::string& name : {result.image, result.mask, result.difference})
      EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
  std::ifstream json(folder / "report.json");
  const std::string text{std::istreambuf_iterator<char>(json), {}};
  EXPECT_EQ(from_json(text, "report.json").results.size(), 3u);
  EXPECT_TRUE(std::filesystem::exists(folder / "report.csv"));
  EXPECT_GT(std::filesystem::file_size(folder / "index.html"), 10'000u);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace shadewright::compare
