#include "compare/difference.h"

#include <gtest/gtest.h>

namespace shadewright::compare {
namespace {

TEST(Difference, ColoursWrongPixelsThatAreCompared) {
  const std::vector<uint8_t> facing = {1, 1, 1, 1, 0}, reference = {1, 1, 0, 0, 0};
  const std::vector<float> visibility = {0.5f, 0.25f, 0.75f, 0.0f, 1.0f};
  MetricsInput input;
  input.width = 5;
  input.height = 1;
  input.facing = facing;
  input.reference = reference;
  input.visibility = visibility;
  const Picture picture = difference_picture(input);
  const glm::u8vec4 nothing(0);
  EXPECT_EQ(picture.pixels, (std::vector<glm::u8vec4>{nothing, false_shadow_color, false_lit_color, nothing, nothing}));
}

}  // namespace
}  // namespace shadewright::compare
