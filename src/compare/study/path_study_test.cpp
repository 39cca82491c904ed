// Techniques over several frames: every frame's truth is of its own time, and figures are sums of the frames'.
#include "shadewright/compare/path_study.h"

#include <filesystem>
#include <fstream>
#include <map>

#include "gpu/device_for_test.h"
#include "shadewright/error.h"
#include "shadewright/scene/builtin.h"

namespace shadewright::compare {
namespace {

class PathStudyTest : public gpu::DeviceTest {
 protected:
  static StudyOptions small() { return {320, 180, 0, 4, true}; }
  static std::vector<shadow::Spec> specs(std::initializer_list<const char*> texts) {
    std::vector<shadow::Spec> result;
    for (const char* text : texts) result.push_back(shadow::parse_spec(text));
    return result;
  }
};

TEST_F(PathStudyTest, EveryFrameIsThatOfItsOwnTime) {
  const Scene scene = make_builtin("street");
  const std::vector<Moment> moments = moments_along(find_path(scene, "main"), scene.lights.front(), 3);
  PathStudy study(device(), scene, "main", moments, small());
  std::vector<uint64_t> wrong;
  const auto watch = [&](uint32_t frame, std::span<const Outcome> outcomes) {
    SCOPED_TRACE(frame);
    // The scene as it stands at that time, without motions.
    Scene frozen = scene;
    for (Instance& instance : frozen.instances) {
      instance.world_from_mesh = transform_at(scene, instance, moments[frame].time);
      instance.motion.reset();
    }
    Study alone(device(), frozen, moments[frame].camera, moments[frame].light, small());
    const std::vector<uint8_t> truth(study.reference().begin(), study.reference().end());
    EXPECT_EQ(truth, std::vector<uint8_t>(alone.reference().begin(), alone.reference().end()));
    const Outcome expected = alone.run(shadow::parse_spec("sm@512"));
    EXPECT_EQ(outcomes[0].visibility, expected.visibility);
    EXPECT_EQ(outcomes[0].result.error.wrong, expected.result.error.wrong);
    EXPECT_EQ(outcomes[0].result.error.flicker.has_value(), frame > 0);
    EXPECT_EQ(outcomes[1].result.error.wrong, 0u);
    wrong.push_back(expected.result.error.wrong);
  };
  const Report report = study.run(specs({"sm@512", "ray"}), {}, watch);

  ASSERT_EQ(wrong.size(), 3u);
  ASSERT_EQ(report.results.size(), 2u);
  const TechniqueResult& map = report.results[0];
  EXPECT_EQ(map.error.wrong, wrong[0] + wrong[1] + wrong[2]);
  EXPECT_EQ(map.error.image_pixels, 3u * 320 * 180);
  EXPECT_DOUBLE_EQ(map.error.fraction, static_cast<double>(map.error.wrong) / static_cast<double>(map.error.compared));
  EXPECT_LE(*map.error.oracle_fraction, 5e-4);
  EXPECT_GT(*map.error.flicker, 0);
  EXPECT_EQ(*report.results[1].error.flicker, 0);
  ASSERT_EQ(map.frames.size(), 3u);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(map.frames[i].wrong, wrong[i]);
  EXPECT_EQ(map.counters.at("views").front(), 1);
  EXPECT_GT(map.memory_bytes(), 512u * 512u * 4u);
  ASSERT_TRUE(report.path.has_value());
  EXPECT_EQ(report.path->name, "main");
  EXPECT_EQ(report.path->frames, 3u);
  EXPECT_EQ(report.path->last_time, moments.back().time);
  EXPECT_FALSE(report.path->light_moves);
  EXPECT_EQ(report.camera.eye, moments[report.path->pictured].camera.eye);
}

/// Nothing but the camera moves, over a map that stays the same: what is wrong stays where it is in the world.
TEST_F(PathStudyTest, AMapThatStaysFlickersLessThanOneThatFollows) {
  const Scene scene = make_builtin("city");
  std::vector<Moment> moments;
  for (int i = 0; i < 3; ++i) {
    Camera camera = scene.cameras.front();
    const glm::dvec3 aside = glm::normalize(glm::cross(camera.target - camera.eye, camera.up));
    camera.eye += 0.5 * i * aside;
    camera.target += 0.5 * i * aside;
    moments.push_back({0, camera, scene.lights.front()});
  }
  PathStudy study(device(), scene, "", moments, small());
  const Report report = study.run(specs({"sm@128,fit=scene", "sm@128,fit=view"}));
  const TechniqueResult &stays = report.results[0], &follows = report.results[1];
  EXPECT_LT(*stays.error.flicker / stays.error.fraction, 0.5 * *follows.error.flicker / follows.error.fraction);
}

TEST_F(PathStudyTest, OneFrameHasNoFlickerAndNoneIsRefused) {
  const Scene scene = make_builtin("spheres");
  const std::vector<Moment> one{{0, scene.cameras.front(), scene.lights.front()}};
  PathStudy study(device(), scene, "", one, small());
  const Report report = study.run(specs({"sm@256"}));
  EXPECT_FALSE(report.results[0].error.flicker.has_value());
  EXPECT_GT(report.results[0].milliseconds.median, 0);
  EXPECT_THROW(PathStudy(device(), scene, "", {}, small()), InputError);
}

TEST_F(PathStudyTest, WritesTheReportOfAPath) {
  const Scene scene = make_builtin("spheres");
  std::vector<Moment> moments = moments_of_motions(scene, scene.cameras.front(), sun(20, 50), 3);
  turn_sun(moments, {20, 50}, {40, 40});
  StudyOptions options = small();
  options.width = 160;
  options.height = 90;
  PathStudy study(device(), scene, "", moments, options);
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "shadewright-path-study-test";
  std::filesystem::remove_all(folder);
  const Report report = compare_along_path(study, specs({"sm@256", "pcf@256"}), folder, true);
  for (const char* name : {"reference-frames/0002.png", "sm-256-frames/0000.png", "pcf-256-frames/0001.png"})
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  for (const auto& result : report.results)
    for (const std::string& name : {result.image, result.mask, result.difference})
      EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  std::ifstream json(folder / "report.json");
  const Report read = from_json({std::istreambuf_iterator<char>(json), {}}, "report.json");
  ASSERT_TRUE(read.path.has_value());
  EXPECT_TRUE(read.path->light_moves);
  EXPECT_EQ(read.path->frames, 3u);
  EXPECT_EQ(read.results[0].frames.size(), 3u);
  EXPECT_GT(*read.results[0].error.flicker, 0);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace shadewright::compare
