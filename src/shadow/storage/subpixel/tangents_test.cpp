#include "shadow/storage/subpixel/tangents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace shadewright::shadow {
namespace {

using Kind = TangentPattern::Kind;

/// Rows from top (y = -1) to bottom, '#' occluded.
uint32_t pattern(const std::string& rows) {
  uint32_t bits = 0;
  for (size_t i = 0; i < 9; ++i) bits |= (rows[i] == '#' ? 1u : 0u) << i;
  return bits;
}

void expect_normals(const std::string& rows, const std::vector<glm::dvec2>& expected) {
  const TangentPattern found = tangent_pattern(pattern(rows));
  ASSERT_EQ(found.kind, Kind::border) << rows;
  ASSERT_EQ(found.normals.size(), expected.size()) << rows;
  for (const glm::dvec2& normal : expected) {
    double best = -1;
    for (const glm::dvec2& n : found.normals) best = std::max(best, glm::dot(n, glm::normalize(normal)));
    EXPECT_NEAR(best, 1, 1e-9) << rows;
  }
}

TEST(TangentsTest, SidesDiagonalsAndCornersHaveOneTangent) {
  expect_normals("##.##.##.", {{-1, 0}});
  expect_normals("...######", {{0, 1}});
  expect_normals("##.##....", {{-1, -1}});
  expect_normals("########.", {{-1, -1}});
  expect_normals("...##....", {{-1, 0}});
}

TEST(TangentsTest, BarsHaveSeveral) {
  expect_normals(".#..#..#.", {{-1, 0}, {1, 0}});
  expect_normals("...###...", {{0, -1}, {0, 1}});
  expect_normals(".#.###.#.", {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}});
}

// Figure 7: conservative rasterization would have marked the texels that an edge to a corner neighbour crosses.
TEST(TangentsTest, DropsWhatOnlyACornerJoins) {
  EXPECT_EQ(tangent_pattern(pattern("#...#....")).kind, Kind::lit);
  EXPECT_EQ(tangent_pattern(pattern("#...#...#")).kind, Kind::lit);
  expect_normals("#...##..#", {{2, 1}});
  expect_normals("#...##...", {{1, 0}});
}

TEST(TangentsTest, TheMiddleDecidesWhereTheRestIsUniform) {
  EXPECT_EQ(tangent_pattern(pattern("####.####")).kind, Kind::lit);
  EXPECT_EQ(tangent_pattern(pattern("....#....")).kind, Kind::lit);
  EXPECT_EQ(tangent_pattern(pattern("#########")).kind, Kind::shadowed);
}

TEST(TangentsTest, EveryPatternHasUnitNormalsAndTurnsWithTheMap) {
  for (uint32_t bits = 0; bits < 512; ++bits) {
    const TangentPattern found = tangent_pattern(bits);
    uint32_t turned = 0;  // (x, y) to (-y, x)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (bits & (1u << ((y + 1) * 3 + x + 1))) turned |= 1u << ((x + 1) * 3 - y + 1);
    const TangentPattern other = tangent_pattern(turned);
    ASSERT_EQ(found.kind, other.kind) << bits;
    ASSERT_EQ(found.normals.size(), other.normals.size()) << bits;
    EXPECT_LE(found.normals.size(), 4u);
    for (const glm::dvec2& n : found.normals) {
      EXPECT_NEAR(glm::length(n), 1, 1e-12);
      double best = -1;
      for (const glm::dvec2& o : other.normals) best = std::max(best, glm::dot(o, glm::dvec2(-n.y, n.x)));
      EXPECT_NEAR(best, 1, 1e-9) << bits;
    }
  }
}

}  // namespace
}  // namespace shadewright::shadow
