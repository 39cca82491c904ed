#include "shadewright/geometry/box.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace shadewright {
namespace {

TEST(Box, IsEmptyUntilExtended) {
  Box box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.diagonal(), 0.0);
  EXPECT_TRUE(transform(glm::dmat4(2.0), box).empty());
  box.extend(glm::dvec3(1, 2, 3));
  EXPECT_FALSE(box.empty());
  EXPECT_TRUE(box.contains({1, 2, 3}));
}

TEST(Box, UnitesAndIntersects) {
  const Box a{{0, 0, 0}, {2, 2, 2}}, b{{1, 1, 1}, {3, 3, 3}}, c{{5, 5, 5}, {6, 6, 6}};
  EXPECT_EQ(unite(a, c).max, glm::dvec3(6));
  EXPECT_EQ(intersect(a, b).min, glm::dvec3(1));
  EXPECT_EQ(intersect(a, b).max, glm::dvec3(2));
  EXPECT_TRUE(intersect(a, c).empty());
  EXPECT_TRUE(intersect(a, Box{}).empty());
  EXPECT_EQ(unite(a, Box{}).max, a.max);
}

TEST(Box, TransformsToTheBoundsOfItsCorners) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-10, 10);
  const auto point = [&] { return glm::dvec3(number(random), number(random), number(random)); };
  for (int i = 0; i < 200; ++i) {
    Box box;
    box.extend(point());
    box.extend(point());
    glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), point());
    for (int column = 0; column < 3; ++column) matrix[column] = glm::dvec4(point(), 0.0);
    Box expected;
    for (const glm::dvec3& corner : box.corners()) expected.extend(glm::dvec3(matrix * glm::dvec4(corner, 1.0)));
    const Box result = transform(matrix, box);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(result.min[axis], expected.min[axis], 1e-11);
      EXPECT_NEAR(result.max[axis], expected.max[axis], 1e-11);
    }
  }
}

}  // namespace
}  // namespace shadewright
