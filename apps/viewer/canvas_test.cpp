#include "canvas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "compare/difference.h"
#include "gpu/device_for_test.h"
#include "shadewright/compare/study.h"
#include "shadewright/scene/load.h"
#include "shadewright/voxel/bake.h"

namespace shadewright::viewer {
namespace {

constexpr uint32_t width = 240, height = 160;

class CanvasTest : public gpu::DeviceTest {
 protected:
  CanvasTest() : scene_(load_scene("builtin:street").scene), canvas_(device(), scene_) {
    canvas_.resize(width, height);
    moment_ = {0, find_camera(scene_, "main"), scene_.lights.front()};
  }
  void choose(size_t side, const std::string& spec) { canvas_.set_technique(side, shadow::parse_spec(spec)); }
  Picture shown(const Look& look) {
    EXPECT_TRUE(canvas_.draw(moment_, look));
    return canvas_.picture();
  }

  Scene scene_;
  Canvas canvas_;
  Moment moment_;
};

bool same(const glm::u8vec4& a, const glm::u8vec4& b, int by = 0) {
  for (int c = 0; c < 3; ++c)
    if (std::abs(int{a[c]} - int{b[c]}) > by) return false;
  return true;
}

TEST_F(CanvasTest, LightsTheSceneAsThePicturesOfAReport) {
  choose(left, "ray");
  const Picture picture = shown({});
  compare::Study study(device(), scene_, moment_.camera, moment_.light, {width, height, 0, 0, true});
  const std::vector<float> truth(study.reference().begin(), study.reference().end());
  const Picture expected = render::to_picture(study.shade(truth), width, height);
  for (size_t i = 0; i < expected.pixels.size(); ++i)
    ASSERT_TRUE(same(picture.pixels[i], expected.pixels[i], 1)) << "pixel " << i % width << ", " << i / width;
}

TEST_F(CanvasTest, ShowsAsManyWrongPixelsAsAReportCounts) {
  choose(left, "sm@128");
  const Picture picture = shown({Show::wrong, 1});
  const auto count = [&](const glm::u8vec4& color) {
    return static_cast<uint64_t>(std::ranges::count_if(picture.pixels, [&](const auto& p) { return same(p, color); }));
  };
  compare::Study study(device(), scene_, moment_.camera, moment_.light, {width, height, 0, 0, true});
  const compare::ErrorFigures expected = study.run(shadow::parse_spec("sm@128")).result.error;
  EXPECT_GT(expected.false_shadow, 50u);
  EXPECT_GT(expected.false_lit, 50u);
  EXPECT_EQ(count(compare::false_shadow_color), expected.false_shadow);
  EXPECT_EQ(count(compare::false_lit_color), expected.false_lit);
  ASSERT_TRUE(canvas_.figures(left).error);
  EXPECT_EQ(canvas_.figures(left).error->wrong, expected.wrong);
  EXPECT_EQ(canvas_.figures(left).error->boundary_fraction, expected.boundary_fraction);
}

TEST_F(CanvasTest, PutsTwoTechniquesSideBySide) {
  choose(left, "sm@128");
  const Picture map = shown({});
  choose(left, "ray");
  const Picture truth = shown({});
  choose(left, "sm@128");
  choose(right, "ray");
  const Picture both = shown({Show::lit, 0.25});
  size_t differ = 0;
  for (size_t i = 0; i < both.pixels.size(); ++i) {
    ASSERT_TRUE(same(both.pixels[i], (i % width < width / 4 ? map : truth).pixels[i])) << i;
    differ += !same(map.pixels[i], truth.pixels[i]);
  }
  EXPECT_GT(differ, 100u);
}

TEST_F(CanvasTest, DrawsAnewOnlyWhatHasChanged) {
  choose(left, "sm@128");
  EXPECT_TRUE(canvas_.draw(moment_, {}));
  EXPECT_FALSE(canvas_.draw(moment_, {}));
  EXPECT_TRUE(canvas_.draw(moment_, {Show::visibility, 1}));
  const Picture before = canvas_.picture();
  moment_.light = sun(200, 20);
  EXPECT_TRUE(canvas_.draw(moment_, {Show::visibility, 1}));
  EXPECT_NE(canvas_.picture().pixels, before.pixels);
  moment_.time = 2;  // cars move
  choose(left, "ray");
  const Picture other_sun = shown({Show::visibility, 1});
  moment_.time = 4;
  EXPECT_NE(shown({Show::visibility, 1}).pixels, other_sun.pixels);
}

TEST_F(CanvasTest, TakesTheFiguresOfAWarmFrame) {
  choose(left, "sm@128");
  EXPECT_TRUE(canvas_.draw(moment_, {}));
  EXPECT_TRUE(canvas_.has_cold_figures());
  const Picture cold = canvas_.picture();
  canvas_.forget_cold_figures();
  EXPECT_TRUE(canvas_.draw(moment_, {}));
  EXPECT_FALSE(canvas_.has_cold_figures());
  EXPECT_EQ(canvas_.picture().pixels, cold.pixels);
  canvas_.forget_cold_figures();
  EXPECT_FALSE(canvas_.draw(moment_, {}));
}

TEST_F(CanvasTest, BakesByTheBakerThatItIsGiven) {
  int bakes = 0;
  Canvas canvas(device(), scene_,
                [&](const Scene& scene, const Light& light, const voxel::BakeOptions& options, const Progress&) {
                  ++bakes;
                  return voxel::bake(scene, light, options).shadow;
                });
  canvas.resize(width, height);
  canvas.set_technique(left, shadow::parse_spec("cpvs@64"));
  canvas.draw(moment_, {});
  moment_.camera.eye.y += 1;
  canvas.draw(moment_, {});
  EXPECT_EQ(bakes, 1);
  moment_.light = sun(100, 50);
  canvas.draw(moment_, {});
  EXPECT_EQ(bakes, 2);
  EXPECT_EQ(canvas.figures(left).problem, "");
}

TEST_F(CanvasTest, OneSidesProblemIsNotTheOthers) {
  moment_.light.kind = LightKind::point;
  moment_.light.position = {0, 30, 0};
  choose(left, "rtw@128");
  choose(right, "sm@128");
  const Picture both = shown({Show::visibility, 0.5});
  EXPECT_NE(canvas_.figures(left).problem.find("six faces"), std::string::npos) << canvas_.figures(left).problem;
  EXPECT_EQ(canvas_.figures(right).problem, "");
  EXPECT_GT(canvas_.figures(right).bytes, 0u);
  size_t dark = 0;
  for (size_t i = 0; i < both.pixels.size(); ++i) {
    const bool is_dark = both.pixels[i].r < 128;
    EXPECT_FALSE(is_dark && i % width < width / 2) << "nobody answered here";
    dark += is_dark;
  }
  EXPECT_GT(dark, 500u);
}

TEST_F(CanvasTest, TakesOnAnotherSize) {
  choose(left, "csm@128");
  shown({});
  canvas_.resize(100, 50);
  const Picture picture = shown({});
  EXPECT_EQ(picture.width, 100u);
  EXPECT_EQ(picture.pixels.size(), 5000u);
  ASSERT_NE(std::ranges::count(canvas_.debug_names(left), "cascades"), 0);
  EXPECT_EQ(canvas_.debug_picture(left, "cascades").width, 100u);
}

}  // namespace
}  // namespace shadewright::viewer
