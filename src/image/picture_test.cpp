#include "shadewright/image/picture.h"

#include <gtest/gtest.h>

#include "base/temporary_folder_for_test.h"
#include "shadewright/error.h"

namespace shadewright {
namespace {

const glm::u8vec4 grey(90, 90, 90, 255), white(255, 255, 255, 255), glass(200, 10, 20, 70), nothing(0);

TEST(Picture, SurvivesPng) {
  const TemporaryFolder folder;
  for (const Picture& picture : {Picture{3, 1, {grey, white, grey}}, Picture{1, 3, {grey, glass, nothing}}}) {
    const std::vector<uint8_t> bytes = encode_png(picture);
    folder.write("a.png", std::string(bytes.begin(), bytes.end()));
    const Picture read = read_png(folder.path() / "a.png");
    EXPECT_EQ(read.width, picture.width);
    EXPECT_EQ(read.height, picture.height);
    EXPECT_EQ(read.pixels, picture.pixels);
  }
}

TEST(Picture, WhatIsNotPngIsRefusedByName) {
  const TemporaryFolder folder;
  folder.write("text.png", "hello");
  for (const char* name : {"text.png", "missing.png"}) {
    try {
      read_png(folder.path() / name);
      ADD_FAILURE() << name << " was read";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace shadewright
