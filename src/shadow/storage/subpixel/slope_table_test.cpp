#include "shadow/storage/subpixel/slope_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace shadewright::shadow {
namespace {

constexpr double degree = std::numbers::pi / 180;

class SlopeTableTest : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    coding = slope_coding(GetParam());
    entries.resize(slope_codes(coding));
    make_slope_table(coding, entries);
  }
  shared::SlopeCoding coding{};
  std::vector<shared::SlopeEntry> entries;
};

TEST_P(SlopeTableTest, DecodesWithinTheStatedErrorOverTheWholeDomain) {
  for (double angle = -89.99; angle < 89.99; angle += 0.003) {
    const double slope = std::tan(angle * degree);
    const uint32_t code = encode_slope(coding, slope);
    ASSERT_LT(code, entries.size());
    const auto [decoded, error] = entries[code];
    if (code == 0 || code + 1 == entries.size()) continue;  // the outermost codes reach to infinity
    ASSERT_LE(std::abs(slope - static_cast<double>(decoded)), static_cast<double>(error) * (1 + 1e-5) + 1e-9)
        << angle << " degrees";
  }
}

TEST_P(SlopeTableTest, RisesFromCodeToCodeAndIsOdd) {
  for (size_t code = 0; code + 1 < entries.size(); ++code) ASSERT_LT(entries[code].slope, entries[code + 1].slope);
  for (size_t code = 0; code < entries.size(); ++code)
    ASSERT_FLOAT_EQ(entries[code].slope, -entries[entries.size() - 1 - code].slope);
  EXPECT_EQ(entries[entries.size() / 2].slope, 0);
}

INSTANTIATE_TEST_SUITE_P(Codings, SlopeTableTest, testing::Values("power", "linear", "wide"));

/// The angles between codes around `degrees`.
double resolution_at(const char* name, double degrees) {
  const shared::SlopeCoding coding = slope_coding(name);
  std::vector<shared::SlopeEntry> entries(slope_codes(coding));
  make_slope_table(coding, entries);
  const uint32_t code = encode_slope(coding, std::tan(degrees * degree));
  const auto angle = [&](uint32_t c) { return std::atan(static_cast<double>(entries[c].slope)) / degree; };
  return angle(code + 1) - angle(code);
}

// Figure 5: linear codes are 0.7 degrees apart everywhere; the fifth power resolves about 0.17 degrees at 80 degrees,
// four times as fine, at the cost of the slopes around 0.
TEST(SlopeCodingTest, HasThePapersResolution) {
  EXPECT_NEAR(resolution_at("linear", 10), 0.70, 0.02);
  EXPECT_NEAR(resolution_at("linear", 80), 0.70, 0.02);
  EXPECT_NEAR(resolution_at("power", 80), 0.2, 0.05);
  EXPECT_GT(resolution_at("linear", 80) / resolution_at("power", 80), 3);
  EXPECT_GT(resolution_at("power", 1), 25);
  EXPECT_LT(resolution_at("wide", 1), 0.1);
  EXPECT_LT(resolution_at("wide", 80), 0.1);
}

}  // namespace
}  // namespace shadewright::shadow
