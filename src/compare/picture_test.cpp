#include "compare/picture.h"

#include <gtest/gtest.h>

#include "compare/report_fixture.h"
#include "shadewright/error.h"

namespace shadewright::compare {
namespace {

const glm::u8vec4 grey(90, 90, 90, 255), white(255, 255, 255, 255), glass(200, 10, 20, 70), nothing(0);

TEST(Picture, SurvivesPng) {
  const TemporaryFolder folder;
  for (const Picture& picture : {Picture{3, 1, {grey, white, grey}}, Picture{1, 3, {grey, glass, nothing}}}) {
    folder.write("a.png", encode_png(picture));
    const Picture read = read_png(folder.path / "a.png");
    EXPECT_EQ(read.width, picture.width);
    EXPECT_EQ(read.height, picture.height);
    EXPECT_EQ(read.pixels, picture.pixels);
  }
}

TEST(Picture, WhatIsNotPngIsRefusedByName) {
  const TemporaryFolder folder;
  folder.write("text.png", {'h', 'e', 'l', 'l', 'o'});
  for (const char* name : {"text.png", "missing.png"}) {
    try {
      read_png(folder.path / name);
      ADD_FAILURE() << name << " was read";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
    }
  }
}

TEST(Picture, DeltaOverItsBaseIsThePicture) {
  const Picture base{2, 2, {grey, grey, white, white}}, picture{2, 2, {grey, white, white, grey}};
  ASSERT_TRUE(has_delta(picture, base));
  EXPECT_EQ(delta(picture, base).pixels, (std::vector<glm::u8vec4>{nothing, white, nothing, grey}));
}

TEST(Picture, DeltaNeedsOpaquePicturesOfOneSize) {
  const Picture base{2, 1, {grey, grey}};
  EXPECT_FALSE(has_delta(Picture{1, 2, {grey, grey}}, base));
  EXPECT_FALSE(has_delta(Picture{2, 1, {grey, glass}}, base));
  EXPECT_FALSE(has_delta(base, Picture{2, 1, {grey, nothing}}));
}

}  // namespace
}  // namespace shadewright::compare
