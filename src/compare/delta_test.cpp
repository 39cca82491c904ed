#include "compare/delta.h"

#include <gtest/gtest.h>

namespace shadewright::compare {
namespace {

const glm::u8vec4 grey(90, 90, 90, 255), white(255, 255, 255, 255), glass(200, 10, 20, 70), nothing(0);

TEST(Delta, DeltaOverItsBaseIsThePicture) {
  const Picture base{2, 2, {grey, grey, white, white}}, picture{2, 2, {grey, white, white, grey}};
  ASSERT_TRUE(has_delta(picture, base));
  EXPECT_EQ(delta(picture, base).pixels, (std::vector<glm::u8vec4>{nothing, white, nothing, grey}));
}

TEST(Delta, DeltaNeedsOpaquePicturesOfOneSize) {
  const Picture base{2, 1, {grey, grey}};
  EXPECT_FALSE(has_delta(Picture{1, 2, {grey, grey}}, base));
  EXPECT_FALSE(has_delta(Picture{2, 1, {grey, glass}}, base));
  EXPECT_FALSE(has_delta(base, Picture{2, 1, {grey, nothing}}));
}

}  // namespace
}  // namespace shadewright::compare
