#include "shadewright/geometry/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace shadewright {
namespace {

glm::dvec3 project(const glm::dmat4& matrix, const glm::dvec3& p) {
  const glm::dvec4 c = matrix * glm::dvec4(p, 1.0);
  return glm::dvec3(c) / c.w;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], tolerance) << "axis " << axis;
}

TEST(LookAlong, PutsForwardOnMinusZAndUpOnY) {
  const glm::dmat4 view = look_along({1, 2, 3}, {5, 0, 0}, {0, 2, 0});
  expect_near(project(view, {1, 2, 3}), {0, 0, 0});
  expect_near(project(view, {4, 2, 3}), {0, 0, -3});
  expect_near(project(view, {1, 3, 3}), {0, 1, 0});
  expect_near(project(view, {1, 2, 4}), {1, 0, 0});
}

TEST(LookAlong, ChoosesAnotherUpWhenParallel) {
  for (const glm::dvec3& forward : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, -1, 1e-14)}) {
    const glm::dmat3 rotation(look_along({0, 0, 0}, forward, {0, 1, 0}));
    EXPECT_NEAR(glm::determinant(rotation), 1.0, 1e-12);
    expect_near(rotation * glm::normalize(forward), {0, 0, -1});
  }
}

TEST(PerspectiveReversed, IsOneAtNearAndZeroAtInfinity) {
  const double fov = 1.0, aspect = 2.0, tangent = std::tan(0.5);
  const glm::dmat4 clip = perspective_reversed_infinite(fov, aspect, 0.25);
  expect_near(project(clip, {0, 0, -0.25}), {0, 0, 1});
  expect_near(project(clip, {0, 0, -1e12}), {0, 0, 0});
  expect_near(project(clip, {10 * tangent * aspect, 10 * tangent, -10}), {1, -1, 0.025});
}

TEST(PerspectiveWindow, FillsTheClipSquare) {
  const glm::dmat4 clip = perspective_window({-0.5, -1}, {2, 0.25}, 0.5, 8);
  expect_near(project(clip, {-0.25, -0.5, -0.5}), {-1, 1, 0});
  expect_near(project(clip, {16, 2, -8}), {1, -1, 1});
}

TEST(Orthographic, FillsTheClipVolume) {
  const glm::dmat4 clip = orthographic({{-1, 2, -9}, {3, 5, -4}});
  expect_near(project(clip, {-1, 2, -4}), {-1, 1, 0});
  expect_near(project(clip, {3, 5, -9}), {1, -1, 1});
}

TEST(PerpendicularAxes, AreOrthonormalEverywhere) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::normal_distribution<double> number;
  for (int i = 0; i < 2000; ++i) {
    glm::dvec3 axis(number(random), number(random), number(random));
    // A third of them very near the pole at -Z, one of them on it.
    if (i % 3 == 0) axis = {axis.x * 1e-9, axis.y * 1e-12, -1.0};
    if (i == 0) axis = {0, 0, -1};
    axis = glm::normalize(axis);
    glm::dvec3 u, v;
    perpendicular_axes(axis, u, v);
    EXPECT_NEAR(glm::length(u), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(v), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(u, v), 0.0, 1e-12);
    expect_near(glm::cross(u, v), axis);
  }
}

}  // namespace
}  // namespace shadewright
