#include "shadewright/geometry/polytope.h"

#include <gtest/gtest.h>

#include <random>

#include "shadewright/geometry/projection.h"

namespace shadewright {
namespace {

/// Volume by the divergence theorem; positive when faces wind counter-clockwise seen from outside.
double volume(const Polytope& polytope) {
  const glm::dvec3 center = polytope.bounds().center();
  double six_volumes = 0;
  for (const auto& [plane, polygon] : polytope.faces)
    for (size_t i = 2; i < polygon.size(); ++i)
      six_volumes += glm::dot(polygon[0] - center, glm::cross(polygon[i - 1] - center, polygon[i] - center));
  return six_volumes / 6;
}

class RandomNumbers {
 public:
  RandomNumbers() : seed_(std::random_device{}()), random_(seed_) {}
  std::string trace() const { return "seed " + std::to_string(seed_); }
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  glm::dvec3 point(double reach) { return {number(-reach, reach), number(-reach, reach), number(-reach, reach)}; }
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 p = point(1);
      if (const double length = glm::length(p); length > 0.1 && length < 1) return p / length;
    }
  }

 private:
  unsigned seed_;
  std::mt19937 random_;
};

TEST(Polytope, OfABoxHasItsVolumeAndBounds) {
  const Box box{{-1, 2, 3}, {4, 5, 7}};
  const Polytope polytope = Polytope::from_box(box);
  EXPECT_EQ(polytope.faces.size(), 6u);
  EXPECT_EQ(polytope.planes().size(), 6u);
  EXPECT_EQ(polytope.points().size(), 24u);
  EXPECT_DOUBLE_EQ(volume(polytope), 5.0 * 3.0 * 4.0);
  EXPECT_EQ(polytope.bounds().min, box.min);
  EXPECT_EQ(polytope.bounds().max, box.max);
  EXPECT_TRUE(Polytope::from_box(Box{}).empty());
  for (const Polytope::Face& face : polytope.faces) {
    for (const glm::dvec3& p : face.polygon) EXPECT_EQ(face.plane.distance(p), 0.0);
    EXPECT_GT(face.plane.distance(box.center()), 0.0);
  }
}

TEST(Polytope, IsUntouchedByPlanesThatMissOrTouchIt) {
  const Polytope cube = Polytope::from_box({glm::dvec3(0), glm::dvec3(1)});
  EXPECT_EQ(clip(cube, {{1, 0, 0}, 0.0}).faces.size(), 6u);
  EXPECT_EQ(clip(cube, {{1, 0, 0}, 1.0}).faces.size(), 6u);
  EXPECT_TRUE(clip(cube, {{1, 0, 0}, -1.0}).empty());
  EXPECT_TRUE(clip(cube, {{1, 0, 0}, -2.0}).empty());
  EXPECT_TRUE(clip(cube, {{1, 0, 0}, -1.0 + 1e-13}).empty()) << "a sliver";
  EXPECT_TRUE(clip(Polytope{}, {{1, 0, 0}, 0.0}).empty());
}

/// A floor seen from straight above is as deep everywhere as the planes that bound what is seen.
TEST(Polytope, StaysWhereItIsFlatAndInThePlane) {
  const Polytope floor = Polytope::from_box({{0, 0.1, 0}, {1, 0.1, 1}});
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(clip(floor, {{0, sign, 0}, -0.1 * sign}).points().size(), 24u);
    EXPECT_TRUE(clip(floor, {{0, sign, 0}, -0.1 * sign - 1e-6}).empty());
  }
}

TEST(Polytope, LosesACornerExactly) {
  const Polytope cube = Polytope::from_box({glm::dvec3(0), glm::dvec3(1)});
  const glm::dvec3 diagonal = glm::normalize(glm::dvec3(1));
  // Keeps x + y + z >= 1: the cube without a corner tetrahedron of volume 1/6, through three of its corners.
  const Polytope rest = clip(cube, {diagonal, -1.0 / std::sqrt(3.0)});
  EXPECT_NEAR(volume(rest), 5.0 / 6.0, 1e-12);
  EXPECT_EQ(rest.faces.size(), 7u);
  EXPECT_EQ(rest.faces.back().polygon.size(), 3u);
}

TEST(Polytope, BothSidesOfACutAddUpToTheWhole) {
  RandomNumbers random;
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 300; ++i) {
    const double scale = std::exp2(random.number(-30, 30));
    const glm::dvec3 center = random.point(3) * scale;
    const Box box{center - glm::dvec3(scale), center + glm::dvec3(scale)};
    Polytope whole = Polytope::from_box(box);
    for (int cuts = 0; cuts < 8 && !whole.empty(); ++cuts) {
      Plane plane{random.direction(), 0.0};
      plane.offset = -glm::dot(plane.normal, center + random.point(0.5) * scale);
      const Polytope kept = clip(whole, plane), rest = clip(whole, {-plane.normal, -plane.offset});
      EXPECT_NEAR((volume(kept) + volume(rest)) / volume(whole), 1.0, 1e-6);
      EXPECT_GE(volume(kept), 0.0);
      for (const glm::dvec3& p : kept.points()) EXPECT_GT(plane.distance(p), -1e-10 * scale);
      for (const Plane& bound : kept.planes())
        for (const glm::dvec3& p : kept.points()) EXPECT_GT(bound.distance(p), -1e-10 * scale);
      if (volume(kept) < 1e-3 * scale * scale * scale) break;
      whole = kept;
    }
  }
}

TEST(Polytope, StaysAPolytopeUnderAProjectiveMap) {
  RandomNumbers random;
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 100; ++i) {
    Polytope polytope = Polytope::from_box({{-1, -1, -30}, {1, 1, -2}});
    polytope = clip(polytope, {random.direction(), 0.5});
    if (polytope.empty()) continue;
    const glm::dmat4 map = perspective_window({-1, -1}, {1, 1}, 1, 40);  // mirrors: y is flipped
    const Polytope mapped = transform(map, polytope);
    EXPECT_GT(volume(mapped), 0) << "faces still wind counter-clockwise";
    const Polytope back = transform(glm::inverse(map), mapped);
    EXPECT_NEAR(volume(back) / volume(polytope), 1, 1e-6);
    for (const Plane& plane : mapped.planes())
      for (const glm::dvec3& p : mapped.points()) EXPECT_GT(plane.distance(p), -1e-9);
  }
}

TEST(Polytope, HullWithAPointHoldsBothAndNoMore) {
  RandomNumbers random;
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 300; ++i) {
    Polytope polytope = Polytope::from_box({glm::dvec3(-1), glm::dvec3(1)});
    for (int cuts = 0; cuts < i % 4; ++cuts) polytope = clip(polytope, {random.direction(), random.number(0.1, 1)});
    const bool at_infinity = i % 3 == 0;
    // On faces, edges and inside too.
    glm::dvec3 point = random.point(3);
    if (i % 5 == 0) point.x = 1;
    if (i % 10 == 0) point.y = 1;
    const glm::dvec4 light = at_infinity ? glm::dvec4(random.direction(), 0) : glm::dvec4(point, 1);
    const std::vector<Plane> planes = hull_planes(polytope, light);
    const Polytope hull = clip(Polytope::from_box({glm::dvec3(-9), glm::dvec3(9)}), planes);
    for (const glm::dvec3& p : polytope.points())
      for (const double t : {0.0, 0.5, 1.0}) {
        const glm::dvec3 between = at_infinity ? p + 8 * t * glm::dvec3(light) : glm::mix(p, point, t);
        for (const Plane& plane : planes) EXPECT_GE(plane.distance(between), -1e-8);
      }
    // Every corner of a bounded hull is a corner of the polytope or the point.
    if (at_infinity) continue;
    const std::vector<glm::dvec3> corners = polytope.points();
    for (const glm::dvec3& p : hull.points()) {
      const bool known =
          glm::length(p - point) < 1e-6 ||
          std::any_of(corners.begin(), corners.end(), [&](const glm::dvec3& c) { return glm::length(p - c) < 1e-6; });
      EXPECT_TRUE(known || i % 5 == 0) << i;
    }
  }
  EXPECT_TRUE(hull_planes({}, {0, 1, 0, 0}).empty());
}

TEST(Frustum, PlanesAgreeWithTheClipVolume) {
  RandomNumbers random;
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 50; ++i) {
    const glm::dmat4 view = look_along(random.point(10), random.direction(), {0, 1, 0});
    const std::vector<glm::dmat4> projections = {perspective_reversed_infinite(1.0, 1.5, 0.1),
                                                 perspective_window({-0.5, -1}, {2, 0.7}, 0.2, 30),
                                                 orthographic({{-5, -3, -20}, {4, 6, 1}})};
    for (const glm::dmat4& projection : projections) {
      const glm::dmat4 clip_from_world = projection * view;
      const std::vector<Plane> planes = frustum_planes(clip_from_world);
      EXPECT_EQ(planes.size(), &projection == &projections[0] ? 5u : 6u) << "the infinite far plane is left out";
      for (int k = 0; k < 100; ++k) {
        const glm::dvec3 p = random.point(20);
        const glm::dvec4 c = clip_from_world * glm::dvec4(p, 1.0);
        const bool in_clip = std::abs(c.x) <= c.w && std::abs(c.y) <= c.w && c.z >= 0 && c.z <= c.w;
        const bool in_planes =
            std::all_of(planes.begin(), planes.end(), [&](const Plane& plane) { return plane.distance(p) >= 0; });
        EXPECT_EQ(in_clip, in_planes);
        EXPECT_EQ(outside({p, p}, planes), !in_planes);
      }
    }
  }
}

TEST(Frustum, ClipsABoxToWhatTheCameraSees) {
  const glm::dmat4 view = look_along({0, 0, 5}, {0, 0, -1}, {0, 1, 0});
  const glm::dmat4 clip_from_world = orthographic({{-1, -1, -10}, {1, 1, 0}}) * view;
  const Polytope seen = clip(Polytope::from_box({glm::dvec3(-2), glm::dvec3(2)}), frustum_planes(clip_from_world));
  EXPECT_NEAR(volume(seen), 2 * 2 * 4, 1e-9);
}

TEST(Outside, IsConservative) {
  const std::vector<Plane> planes = {{{1, 0, 0}, 0.0}};
  EXPECT_TRUE(outside({{-2, 0, 0}, {-1, 1, 1}}, planes));
  EXPECT_FALSE(outside({{-2, 0, 0}, {1, 1, 1}}, planes));
  EXPECT_TRUE(outside(Box{}, planes));
}

}  // namespace
}  // namespace shadewright
