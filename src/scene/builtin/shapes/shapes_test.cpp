// Every shape maker that claims to be closed is, and its outside is outside.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "scene/builtin/mesh_check.h"
#include "scene/builtin/random.h"
#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/extrude.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/panel.h"
#include "scene/builtin/shapes/sheet.h"
#include "scene/builtin/shapes/subdivide.h"
#include "scene/builtin/shapes/sweep.h"
#include "scene/builtin/shapes/terrain.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;

void expect_solid(const Mesh& mesh, double volume, double tolerance = 1e-5) {
  EXPECT_EQ(count_unsound_triangles(mesh), 0u);
  EXPECT_EQ(count_open_edges(mesh), 0u);
  EXPECT_NEAR(signed_volume(mesh) / 6, volume, tolerance * volume);
}

/// Area of a regular polygon of unit radius.
double polygon_area(int sides) {
  return 0.5 * sides * std::sin(2 * pi / sides);
}

TEST(Shapes, Boxes) {
  expect_solid(box({1, 2, 3}, {2, 4, 6}), 6);
  expect_solid(tapered_box({1, 1}, {0.5, 0.5}, 3), 7);
  expect_solid(beam({0, 0, 0}, {0, 3, 4}, 0.2, 0.1), 0.1);
  expect_solid(beam({1, 1, 1}, {1, 4, 1}, 0.2, 0.1), 0.06);
}

TEST(Shapes, SurfacesOfRevolution) {
  expect_solid(cylinder(2, 3, 40), 12 * polygon_area(40));
  expect_solid(cone(2, 0, 3, 40), 4 * polygon_area(40));
  expect_solid(pipe(1, 2, 3, 12), 9 * polygon_area(12));
  expect_solid(sphere(1, 96, 64), 4.0 / 3 * pi, 3e-3);
  expect_solid(torus(2, 0.5, 96, 64), 2 * pi * pi * 2 * 0.25, 5e-3);
  // Hollow: up the outside, down the inside.
  expect_solid(lathe(Profile{{1, 0}, {1, 2}, {0.5, 2}, {0.5, 1}, {0, 1}}, 24), polygon_area(24) * (2 - 0.25));
}

TEST(Shapes, Sweeps) {
  expect_solid(rod({1, 2, 3}, {1, 2, 8}, 0.3, 7), 5 * 0.09 * polygon_area(7));
  expect_solid(rod({1, 2, 3}, {-4, 2, 3}, 0.3, 7), 5 * 0.09 * polygon_area(7));
  expect_solid(rod({1, 2, 3}, {1, 7, 3}, 0.3, 7), 5 * 0.09 * polygon_area(7));
  Path circle;
  for (int i = 0; i < 200; ++i)
    circle.emplace_back(2 * std::cos(2 * pi * i / 200), 0.0, 2 * std::sin(2 * pi * i / 200));
  expect_solid(tube(circle, 0.4, 48, Ends::joined), 2 * pi * 2 * 0.16 * polygon_area(48), 1e-3);
  const Path curl =
      smooth_path(std::array{glm::dvec3(0, 0, 0), glm::dvec3(1, 2, 0), glm::dvec3(0, 3, 2), glm::dvec3(-2, 1, 1)}, 8);
  const Mesh tapered = tapered_tube(curl, 0.1, 0, 5);
  EXPECT_EQ(count_unsound_triangles(tapered), 0u);
  EXPECT_EQ(count_open_edges(tapered), 0u);
  EXPECT_GT(signed_volume(tapered), 0);
}

TEST(Shapes, Extrusions) {
  const Polygon ell = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 4}, {0, 4}};
  EXPECT_EQ(triangulate(ell).size(), 4u);
  expect_solid(extrude(ell, -1, 1), 12);
  const Mesh bevelled = extrude(ell, -1, 1, 0.1);
  EXPECT_EQ(count_open_edges(bevelled), 0u);
  EXPECT_LT(signed_volume(bevelled) / 6, 12);
  EXPECT_GT(signed_volume(bevelled) / 6, 11);
  // A mirror keeps the outside outside.
  expect_solid(transformed(extrude(ell, -1, 1), scaled({1, -1, 1})), 12);

  Random random(7);
  for (int trial = 0; trial < 200; ++trial) {
    Polygon star;
    const int corners = 5 + static_cast<int>(random.index(40));
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * pi * i / corners, radius = random.range(0.3, 2);
      star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    double area = 0;
    for (size_t i = 0; i < star.size(); ++i) {
      const glm::dvec2 a = star[i], b = star[(i + 1) % star.size()];
      area += 0.5 * (a.x * b.y - a.y * b.x);
    }
    SCOPED_TRACE(trial);
    EXPECT_EQ(triangulate(star).size(), star.size() - 2);
    expect_solid(extrude(star, 0, 0.5), 0.5 * area);
  }
}

TEST(Shapes, PanelsAndTerrain) {
  const std::array<double, 6> xs = {0, 1, 2, 3, 4, 5}, ys = xs;
  expect_solid(panel(xs, ys, 0, 0.5, [](size_t i, size_t j) { return i % 2 == 0 || j % 2 == 0; }), 0.5 * 21);
  expect_solid(terrain_solid({0, 0}, {2, 3}, 7, 5, -1, [](double, double) { return 1.0; }), 12);
  const Mesh hills =
      terrain_solid({0, 0}, {2, 3}, 7, 5, -1, [](double x, double z) { return std::sin(9 * x) * std::cos(5 * z); });
  EXPECT_EQ(hills.triangles.size(), 2u * 7 * 5 + 6 * (7 + 5));
  EXPECT_EQ(count_open_edges(hills), 0u);
}

TEST(Shapes, SheetsLeaveOutCells) {
  const auto flat = [](uint32_t i, uint32_t j) { return glm::dvec3(i, j, 0); };
  const Mesh mesh = sheet(3, 3, flat, [](uint32_t i, uint32_t j) { return i != 1 || j != 1; });
  EXPECT_EQ(mesh.triangles.size(), 16u);
  EXPECT_EQ(mesh.positions.size(), 16u);
  EXPECT_EQ(count_unsound_triangles(mesh), 0u);
  EXPECT_EQ(count_open_edges(mesh), 16u);  // around the outside and around the hole
}

TEST(Shapes, SubdivisionKeepsClosedAndRounds) {
  QuadMesh cube;
  for (int c = 0; c < 8; ++c) cube.positions.emplace_back(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1);
  cube.quads = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  expect_solid(to_triangles(cube), 8);
  const QuadMesh once = subdivide(cube);
  EXPECT_EQ(once.quads.size(), 24u);
  // A cube's corner: F = (1/3, 1/3, 1/3), R = (2/3, 2/3, 2/3) towards it, so (F + 2 R) / 3 = 5/9.
  EXPECT_NEAR(glm::length(once.positions[7] - glm::dvec3(5.0 / 9)), 0, 1e-12);
  const Mesh smooth_cube = to_triangles(subdivide(subdivide(once)));
  EXPECT_EQ(count_unsound_triangles(smooth_cube), 0u);
  EXPECT_EQ(count_open_edges(smooth_cube), 0u);
}

TEST(Random, IsPcg32) {
  // The first numbers of the reference program's demo: seed 42, stream 54 (pcg-random.org).
  Random random(42, 54);
  for (const uint32_t expected : {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu})
    EXPECT_EQ(random.next(), expected);
}

}  // namespace
}  // namespace shadewright::builtin
