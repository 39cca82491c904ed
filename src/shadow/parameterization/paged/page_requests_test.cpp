// The ways in which the pages of a paged map are found: whichever, the same pages.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "shadewright/error.h"
#include "shadewright/scene/builtin.h"
#include "shadow/parameterization/paged/paged_for_test.h"

namespace shadewright::compare {
namespace {

class PageRequestsTest : public PagedTest {
 protected:
  static void expect_same_pages(const Outcome& a, const Outcome& b) {
    for (const char* name : {"raw_requests", "unique_requests", "pages", "pages_drawn"})
      EXPECT_EQ(counter(a.result, name), counter(b.result, name)) << name;
    EXPECT_EQ(a.debug.front().pixels, b.debug.front().pixels);
    EXPECT_EQ(a.visibility, b.visibility);
  }
};

/// A picture of the table has a pixel a page: those in the pool are grey, by how many of their texels are read.
TEST_F(PageRequestsTest, ThePageTableCanBeSeen) {
  const Scene scene = make_builtin("furball");
  Study study(device(), scene, scene.cameras.back(), scene.lights.front(), small());
  const Outcome outcome = run_with_table(study, "rmsm,statistics=on");
  const Picture& picture = outcome.debug.front();
  ASSERT_EQ(picture.width, 1536u);
  ASSERT_EQ(picture.height, 1024u);
  const std::vector<double> use = use_of_pages(picture);
  const auto pages = static_cast<double>(use.size());
  EXPECT_GE(pages, counter(outcome.result, "pages"));  // and those of whole blocks that nobody asked for
  EXPECT_NEAR(std::accumulate(use.begin(), use.end(), 0.0) / pages, counter(outcome.result, "page_utilization"), 0.002);
}

/// Each step of RMSM's section 3.2 shortens the list, and none changes what is asked for; of refinement neither.
TEST_F(PageRequestsTest, EveryStepThinsTheList) {
  const Scene scene = make_builtin("furball");
  Study study(device(), scene, scene.cameras.back(), scene.lights.front(), {256, 256, 0, 0, true});
  for (const std::string spec : {"rmsm", "asm@8192"}) {
    SCOPED_TRACE(spec);
    const Outcome bits = run_with_table(study, spec), none = run_with_table(study, spec + ",uniquify=none"),
                  components = run_with_table(study, spec + ",uniquify=components"),
                  compact = run_with_table(study, spec + ",uniquify=compact"),
                  full = run_with_table(study, spec + ",uniquify=full");
    for (const Outcome* list : {&none, &components, &compact, &full}) expect_same_pages(*list, bits);
    EXPECT_EQ(full.result.counters, run_with_table(study, spec + ",requests=sort").result.counters);
    const double whole = counter(none.result, "listed_requests");
    EXPECT_GE(whole, 256 * 256);
    EXPECT_EQ(counter(components.result, "listed_requests"), whole);
    EXPECT_EQ(counter(compact.result, "listed_requests"), counter(compact.result, "compacted_requests"));
    EXPECT_EQ(counter(full.result, "compacted_requests"), counter(compact.result, "compacted_requests"));
    EXPECT_EQ(counter(full.result, "listed_requests"), counter(full.result, "sorted_unique_requests"));
    EXPECT_EQ(counter(full.result, "listed_requests"), counter(bits.result, "unique_requests"));
    EXPECT_LT(counter(compact.result, "compacted_requests"), counter(bits.result, "raw_requests"));
    EXPECT_LT(counter(full.result, "listed_requests"), counter(compact.result, "listed_requests"));
    for (const Outcome* list : {&none, &components}) EXPECT_FALSE(list->result.counters.contains("compacted_requests"));
    const auto sorts = [](const Outcome& outcome) {
      const auto& stages = outcome.result.milliseconds.stages;
      return std::any_of(stages.begin(), stages.end(), [](const StageTime& stage) { return stage.name == "sort"; });
    };
    EXPECT_TRUE(sorts(full));
    EXPECT_FALSE(sorts(compact));
  }
}

/// The host finds in the list what the device does, whether it gets all of it or what the device has thinned.
TEST_F(PageRequestsTest, TheHostFindsTheSamePages) {
  struct View {
    const char *scene, *camera;
    LightKind light;
    std::vector<std::string> specs;
  };
  for (const View& view : {View{"furball", "furball", LightKind::directional, {"rmsm@8192", "paged/depth/hard"}},
                           View{"furball", "wall", LightKind::directional, {"rmsm@8192", "asm@8192"}},
                           View{"city", "street", LightKind::directional, {"rmsm", "asm@16384"}},
                           View{"sandbox", "main", LightKind::point, {"rmsm@4096", "asm@4096"}}}) {
    SCOPED_TRACE(fmt::format("{} {}", view.scene, view.camera));
    const Scene scene = make_builtin(view.scene);
    const Camera camera = find_camera(scene, view.camera);
    Light lamp;
    lamp.kind = LightKind::point;
    lamp.position = camera.target + glm::dvec3(0.3, 1.1, 0.2);
    Study study(device(), scene, camera, view.light == LightKind::point ? lamp : scene.lights.front(),
                {256, 256, 0, 0, true});
    for (const std::string& spec : view.specs) {
      SCOPED_TRACE(spec);
      const Outcome gpu = run_with_table(study, spec), cpu = run_with_table(study, spec + ",analysis=cpu");
      expect_same_pages(cpu, gpu);
      if (spec != view.specs.front()) continue;
      const Outcome thinned = run_with_table(study, spec + ",analysis=cpu,uniquify=compact");
      expect_same_pages(thinned, gpu);
      EXPECT_LT(counter(thinned.result, "listed_requests"), counter(cpu.result, "listed_requests"));
      EXPECT_EQ(counter(thinned.result, "listed_requests"), counter(thinned.result, "compacted_requests"));
    }
  }
}

TEST_F(PageRequestsTest, RefusesToLeavePixelsOutOfAList) {
  const Scene scene = make_builtin("spheres");
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), small());
  for (const std::string key : {"uniquify=none", "requests=sort", "analysis=cpu", "refine=edges"})
    EXPECT_THROW(run(study, "rmsm,analysis_scale=2," + key), InputError) << key;
}

}  // namespace
}  // namespace shadewright::compare
