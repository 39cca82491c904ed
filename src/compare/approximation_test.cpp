#include "shadewright/compare/approximation.h"

#include <gtest/gtest.h>

#include <vector>

#include "shadewright/error.h"

namespace shadewright::compare {
namespace {

const SurfacePoint up{{0, 0, 0}, {0, 1, 0}}, down{{0, 0, 0}, {0, -1, 0}}, nothing{};

TEST(ApproximationError, CountsLitOnceAndCoverageApart) {
  const Light noon = sun(0, 90);
  // Same; lit against dark; lit against turned away; gone; not compared; there was nothing.
  const std::vector<SurfacePoint> exact{up, up, up, up, down, nothing}, shown{up, up, down, nothing, up, up};
  const std::vector<uint8_t> exact_visible{1, 1, 1, 0, 0, 0};
  const std::vector<float> shown_visible{0.5f, 0.4f, 1, 1, 1, 0};
  const ApproximationError error = approximation_error(exact, exact_visible, shown, shown_visible, noon);
  EXPECT_EQ(error.compared, 4u);
  EXPECT_EQ(error.wrong, 2u);
  EXPECT_EQ(error.coverage, 2u);
  EXPECT_EQ(error.fraction, 0.5);
  EXPECT_EQ(error.lit_exact, 0.75);
  EXPECT_EQ(error.lit_shown, 0.5);
}

TEST(ApproximationError, RefusesImagesOfDifferentSizes) {
  const std::vector<SurfacePoint> one{up}, two{up, up};
  const std::vector<uint8_t> visible{1};
  const std::vector<float> shown_visible{1, 1};
  EXPECT_THROW(approximation_error(one, visible, two, shown_visible, sun(0, 90)), InputError);
}

}  // namespace
}  // namespace shadewright::compare
