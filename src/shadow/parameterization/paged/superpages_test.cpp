// Superpages: how pages are binned, and that what is copied out of them is what is drawn straight into the pool.
#include "shadow/parameterization/paged/superpages.h"

#include <array>
#include <cmath>
#include <random>
#include <set>

#include "shadewright/scene/builtin.h"
#include "shadow/parameterization/paged/paged_for_test.h"

namespace shadewright::compare {
namespace {

using shadow::bin_superpages;
using shadow::Superpage;
using shared::page_base;
using shared::z_curve_place;

/// Every page of the mask is in the superpage of its face, level and place, once; superpages have no other pages.
TEST(SuperpagesTest, HoldThePagesOfAMask) {
  constexpr uint32_t top = 7, faces = 2;  // levels of 128 x 128 pages down to one
  const uint32_t words = page_base(top + 1) / 32;
  std::mt19937 random(5);
  std::vector<uint32_t> mask(words * faces, 0), pages(1000);
  std::set<uint32_t> expected;
  const auto add = [&](uint32_t page) {
    mask[page / 32] |= 1u << page % 32;
    expected.insert(page);
  };
  add(0);  // the coarsest level's only page
  add(words * 32);
  const auto below = [&](uint32_t end) { return std::uniform_int_distribution<uint32_t>(0, end - 1)(random); };
  for (int i = 0; i < 500; ++i) {
    const uint32_t k = 3 + below(top - 2), face = below(faces);
    add(face * words * 32 + page_base(k) + below(1u << 2 * k));
  }
  std::vector<Superpage> superpages;
  bin_superpages(mask, words, top, pages, superpages);

  std::set<uint32_t> found;
  std::set<std::array<uint32_t, 4>> places;
  uint32_t listed = 0;
  for (const Superpage& superpage : superpages) {
    EXPECT_TRUE(
        places.insert({superpage.face, superpage.level, superpage.first_page.x, superpage.first_page.y}).second);
    EXPECT_EQ(superpage.first_page % 32u, glm::uvec2(0));
    EXPECT_EQ(superpage.first, listed);
    EXPECT_GT(superpage.page_count, 0u);
    for (; listed < superpage.first + superpage.page_count; ++listed) {
      const uint32_t page = pages[listed], number = page % (words * 32) - page_base(top - superpage.level);
      EXPECT_EQ(page / (words * 32), superpage.face);
      EXPECT_LT(number, 1u << 2 * (top - superpage.level));
      EXPECT_EQ(z_curve_place(number) / 32u * 32u, superpage.first_page);
      found.insert(page);
    }
  }
  EXPECT_EQ(found, expected);
}

TEST(SuperpagesTest, AnEmptyMaskHasNone) {
  std::vector<Superpage> superpages{{}};
  std::vector<uint32_t> pages(32);
  bin_superpages(std::vector<uint32_t>(page_base(6) / 32, 0), page_base(6) / 32, 5, pages, superpages);
  EXPECT_TRUE(superpages.empty());
}

class SuperpageDrawsTest : public PagedTest {
 protected:
  /// Both ways draw the same casters; a vertex may be snapped otherwise where its place in the target is rounded, and
  /// then refinement may ask for other pages.
  static void expect_same(Study& study, const std::string& spec) {
    SCOPED_TRACE(spec);
    const Outcome pages = run_with_table(study, spec), superpages = run_with_table(study, spec + ",draw=superpages");
    const bool refines = spec.starts_with("asm");
    for (const char* name : {"raw_requests", "unique_requests"})
      EXPECT_NEAR(counter(superpages.result, name), counter(pages.result, name),
                  refines ? 0.01 * counter(pages.result, name) : 0)
          << name;
    size_t different = 0;
    for (size_t i = 0; i < pages.visibility.size(); ++i)
      different += std::abs(pages.visibility[i] - superpages.visibility[i]) > 0.1f ? 1 : 0;
    EXPECT_LE(static_cast<double>(different), 2e-4 * static_cast<double>(pages.visibility.size()));
    EXPECT_LE(superpages.result.error.oracle_fraction.value_or(0), 5e-4);
    EXPECT_GT(counter(superpages.result, "superpages"), 0);
    EXPECT_LT(counter(superpages.result, "superpages"), counter(superpages.result, "pages"));
    if (refines) return;
    const auto in_pool = static_cast<double>(use_of_pages(superpages.debug.front()).size());
    EXPECT_EQ(in_pool, counter(superpages.result, "pages"));
    EXPECT_EQ(in_pool, counter(superpages.result, "unique_requests"));
  }
};

TEST_F(SuperpageDrawsTest, ShowWhatPagesDrawnStraightIntoThePoolDo) {
  const Scene furball = make_builtin("furball");
  Study study(device(), furball, furball.cameras.back(), furball.lights.front(), small());
  for (const char* spec : {"rmsm,analysis=cpu", "paged/depth/hard", "asm@8192"}) expect_same(study, spec);
  const Scene city = make_builtin("city");
  Study street(device(), city, city.cameras.front(), city.lights.front(), small());
  for (const char* spec : {"rmsm,requests=sort", "paged/depth/hard@1024"}) expect_same(street, spec);
}

TEST_F(SuperpageDrawsTest, ServeSpotAndPointLights) {
  const Scene scene = make_builtin("sandbox");
  for (const LightKind kind : {LightKind::spot, LightKind::point}) {
    Study study(device(), scene, scene.cameras.front(), lamp(scene, kind), small());
    const TechniqueResult pages = run(study, "paged/depth/hard@8192"),
                          superpages = run(study, "paged/depth/hard@8192,draw=superpages");
    EXPECT_EQ(counter(superpages, "unique_requests"), counter(pages, "unique_requests"));
    EXPECT_LE(superpages.error.oracle_fraction.value_or(0), 5e-4);
    EXPECT_NEAR(superpages.error.fraction, pages.error.fraction, 1e-4);
  }
}

/// Where nothing is new no superpage is drawn.
TEST_F(SuperpageDrawsTest, ACachedFrameDrawsNone) {
  const Scene scene = make_builtin("city");
  StudyOptions options = small();
  options.repeat = 2;
  Study study(device(), scene, scene.cameras.front(), scene.lights.front(), options);
  const Outcome fresh = study.run(shadow::parse_spec("rmsm,draw=superpages")),
                kept = study.run(shadow::parse_spec("rmsm,draw=superpages,cache=on"));
  EXPECT_GT(counter(fresh.result, "superpages"), 0);
  EXPECT_EQ(counter(kept.result, "superpages"), 0);
  EXPECT_EQ(kept.visibility, fresh.visibility);
}

}  // namespace
}  // namespace shadewright::compare
