#include "shadow/receiver_strips.h"

#include <gtest/gtest.h>

namespace shadewright::shadow {
namespace {

TEST(ReceiverStripsTest, ShareTheImage) {
  for (const uint32_t width : {1u, 97u, 5120u, 16384u})
    for (const uint32_t height : {1u, 7u, 61u, 2800u, 16384u})
      for (const uint64_t most : {uint64_t{1}, uint64_t{100'000}, uint64_t{65535} * 64, uint64_t{1} << 27}) {
        uint32_t next = 0;
        for (const shared::ReceiverStrip& strip : receiver_strips(width, height, most)) {
          ASSERT_EQ(strip.first_row, next);
          ASSERT_GT(strip.rows, 0u);
          next += strip.rows;
          ASSERT_TRUE(strip.rows % strip_alignment == 0 || next == height);
          ASSERT_TRUE(uint64_t{strip.rows} * width <= most || strip.rows <= strip_alignment);
        }
        ASSERT_EQ(next, height);
      }
}

TEST(ReceiverStripsTest, AreAsFewAsCanBe) {
  EXPECT_EQ(receiver_strips(1920, 1080, 65535 * 64).size(), 1u);
  EXPECT_EQ(receiver_strips(5120, 2800, 65535 * 64).size(), 4u);
}

}  // namespace
}  // namespace shadewright::shadow
