#include "camera_moves.h"

#include <gtest/gtest.h>

namespace shadewright::viewer {
namespace {

Camera ahead() {
  Camera camera;
  camera.eye = {1, 2, 3};
  camera.target = {1, 2, -7};
  return camera;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
  EXPECT_NEAR(glm::distance(a, b), 0, 1e-9) << a.x << " " << a.y << " " << a.z;
}

TEST(CameraMoves, TurnsToTheRightAndUpAboutTheEye) {
  const Camera right = turned(ahead(), glm::radians(90.0), 0);
  expect_near(right.eye, {1, 2, 3});
  expect_near(right.target, {11, 2, 3});
  const Camera up = turned(ahead(), 0, glm::radians(30.0));
  expect_near(up.target, {1, 7, 3 - 10 * std::cos(glm::radians(30.0))});
}

TEST(CameraMoves, DoesNotTipOver) {
  const Camera camera = turned(ahead(), 0, 10);
  EXPECT_GT(camera.target.y, camera.eye.y + 9.9);
  EXPECT_LT(camera.target.z, camera.eye.z);
  expect_near(turned(camera, 0, -glm::radians(89.0)).target, {1, 2, -7});
}

TEST(CameraMoves, CirclesWhatItLooksAt) {
  const Camera camera = circled(ahead(), glm::radians(90.0), 0);
  expect_near(camera.target, {1, 2, -7});
  expect_near(camera.eye, {-9, 2, -7});
}

TEST(CameraMoves, KeepsTheUpperEdgeOfACameraThatLooksStraightDown) {
  Camera down;
  down.eye = {0, 10, 0};
  down.target = {0, 0, 0};
  down.up = {1, 0, 0};
  const Camera camera = turned(down, 0, glm::radians(45.0));
  // +X was up in the image: tilted up, it looks that way.
  EXPECT_GT(camera.target.x, 1);
  EXPECT_NEAR(camera.target.z, 0, 1e-9);
}

TEST(CameraMoves, MovesAlongItsOwnAxesWithWhatItLooksAt) {
  const Camera camera = moved(ahead(), {1, 2, 3});
  expect_near(camera.eye, {2, 4, 0});
  expect_near(camera.target, {2, 4, -10});
  expect_near(approached(ahead(), 0.5, 1, 100).eye, {1, 2, -2});
  expect_near(approached(ahead(), 0.01, 1, 100).eye, {1, 2, -6});
  expect_near(approached(ahead(), 30, 1, 100).eye, {1, 2, 93});
}

TEST(CameraMoves, WalkWhileLookingStraightDown) {
  Camera down;
  down.eye = {0, 10, 0};
  down.target = {0, 0, 0};  // and +Y up, which does not tell where right is
  const Camera camera = moved(down, {1, 0, 2});
  EXPECT_NEAR(camera.eye.y, 8, 1e-9);
  EXPECT_NEAR(glm::length(glm::dvec2(camera.eye.x, camera.eye.z)), 1, 1e-9);
  EXPECT_TRUE(std::isfinite(turned(camera, 0.1, 0.1).target.x));
}

}  // namespace
}  // namespace shadewright::viewer
