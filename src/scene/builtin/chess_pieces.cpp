#include "scene/builtin/chess_pieces.h"

#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/extrude.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/loft.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/sweep.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr uint32_t segments = 22;

/// Profiles are drawn in millimetres.
Mesh in_metres(const Mesh& millimetres) {
  return transformed(millimetres, scaled(glm::dvec3(0.001)));
}

/// The foot that all pieces share: `radius` wide, up to 0.8 radius high.
Profile foot(double radius) {
  const double r = radius;
  return {{r * 0.96, 0}, {r, 0.1 * r}, {r, 0.28 * r}, {0.9 * r, 0.38 * r}, {0.86 * r, 0.46 * r}, {0.7 * r, 0.62 * r}};
}

void extend(Profile& profile, const Profile& more) {
  profile.insert(profile.end(), more.begin(), more.end());
}

/// A ball's profile from `start` radians above its south to its north pole.
Profile ball(double radius, double height, double start, int steps) {
  Profile result;
  for (int i = 0; i < steps; ++i) {
    const double angle = start + (pi - start) * i / steps;
    result.emplace_back(radius * std::sin(angle), height - radius * std::cos(angle));
  }
  result.emplace_back(0.0, height + radius);
  return result;
}

/// One ring of a horse's neck or head: an ellipse between the throat's and the mane's side of the silhouette.
Ring rung(const glm::dvec3& throat, const glm::dvec3& mane, double half_width) {
  Ring ring;
  const glm::dvec3 center = 0.5 * (throat + mane), half = 0.5 * (mane - throat);
  constexpr int sides = 14;
  for (int j = 0; j < sides; ++j) {
    const double angle = 2 * pi * j / sides;
    const double c = std::cos(angle), s = std::sin(angle);
    ring.push_back(center + glm::dvec3(0, 0, -half_width * c) + s * half);
  }
  return ring;
}

}  // namespace

Mesh chess_pawn() {
  Profile profile = foot(15);
  extend(profile, {{8, 13}, {6.6, 18}, {5.8, 24}, {5.6, 28.5}, {9, 30.2}, {9, 31.8}, {5.4, 33.4}});
  extend(profile, ball(8.2, 40, 0.75, 9));
  return in_metres(lathe(profile, segments));
}

Mesh chess_rook() {
  Profile profile = foot(17);
  extend(profile,
         {{11, 14}, {9.6, 20}, {9, 30}, {9.2, 38}, {11, 41}, {13.2, 43}, {13.2, 50}, {9.6, 50}, {9.4, 46.5}, {0, 46}});
  Mesh mesh = lathe(profile, segments);
  // Battlements: arcs that stand on the rim, sunk into it by half a millimetre.
  constexpr int merlons = 6, steps = 3;
  for (int k = 0; k < merlons; ++k) {
    std::vector<Ring> rings;
    for (int i = 0; i <= steps; ++i) {
      const double angle = 2 * pi * (k + 0.64 * i / steps) / merlons;
      const glm::dvec3 out(std::cos(angle), 0, -std::sin(angle));
      rings.push_back({13.0 * out + glm::dvec3(0, 49.5, 0), 9.9 * out + glm::dvec3(0, 49.5, 0),
                       9.9 * out + glm::dvec3(0, 55, 0), 13.0 * out + glm::dvec3(0, 55, 0)});
    }
    for (Ring& ring : rings) std::swap(ring[1], ring[3]);
    append(mesh, loft(rings));
  }
  return in_metres(mesh);
}

Mesh chess_knight() {
  Profile base = foot(17);
  extend(base, {{11.5, 12.5}, {11, 14.5}, {0, 15.5}});
  Mesh mesh = lathe(base, segments);

  // The silhouette as rungs that turn about the throat: throat side, mane side, half width.
  const Path throat = {{11, 12, 0},    {10.5, 18, 0}, {7.5, 24, 0},  {4.8, 29, 0},  {4.6, 33, 0},
                       {7.4, 34.8, 0}, {11, 34, 0},   {14, 32.2, 0}, {17.2, 30, 0}, {19.4, 29, 0}};
  const Path mane = {{-11, 13, 0}, {-12.5, 22, 0}, {-11.5, 33, 0}, {-8.5, 43, 0},   {-4, 51, 0},
                     {2, 54.5, 0}, {8.5, 51, 0},   {14, 45, 0},    {19.5, 39.4, 0}, {22.2, 36, 0}};
  const Path width = {{10, 0, 0},  {8.6, 0, 0}, {7.4, 0, 0}, {6.8, 0, 0}, {6.6, 0, 0},
                      {6.6, 0, 0}, {6, 0, 0},   {5, 0, 0},   {4.6, 0, 0}, {3.9, 0, 0}};
  const Path t = smooth_path(throat, 2), m = smooth_path(mane, 2), w = smooth_path(width, 2);
  std::vector<Ring> rings;
  for (size_t i = 0; i < t.size(); ++i) rings.push_back(rung(t[i], m[i], w[i].x));
  rings.push_back(rung({20.8, 30.2, 0}, {22.4, 34.2, 0}, 2.2));
  append(mesh, loft(rings));

  // A toothed mane along the neck, ears, eyes and nostrils.
  Polygon comb;
  const Polygon crest = {{-9.5, 18},   {-14.4, 21.5}, {-12, 24.5},  {-14.2, 29}, {-11.4, 31.5}, {-12.8, 36.5},
                         {-9.6, 38.5}, {-10, 43.8},   {-6.6, 45.2}, {-5.6, 51},  {-2.4, 51},    {1, 57},
                         {3, 53},      {1, 49},       {-4, 44},     {-7, 34},    {-8.5, 26}};
  for (size_t i = crest.size(); i-- > 0;) comb.push_back(crest[i]);
  append(mesh, extrude(comb, -1.7, 1.7, 0.6));
  for (const double side : {-1.0, 1.0}) {
    append(mesh, cone(2.1, 0, 8, 8), along({0.5, 51.5, 3.4 * side}, {-0.1, 1, 0.18 * side}));
    append(mesh, sphere(1.3, 8, 6), moved({8.6, 46.2, 5.4 * side}));
    append(mesh, sphere(0.8, 6, 4), moved({20.6, 34.6, 3.2 * side}));
  }
  return in_metres(mesh);
}

Mesh chess_bishop() {
  Profile profile = foot(16);
  extend(profile, {{9, 15}, {7.2, 22}, {6, 32}, {5.8, 41}, {10, 43}, {10, 45}, {7, 46.6}, {6.4, 49}});
  extend(profile, {{8.8, 53}, {9.4, 57}, {8.6, 61.5}, {6, 66}, {2.6, 69.6}});
  extend(profile, ball(2.7, 71.6, 0.9, 5));
  return in_metres(lathe(profile, segments));
}

Mesh chess_queen() {
  Profile profile = foot(18);
  extend(profile, {{10.5, 16}, {8.4, 25}, {6.8, 38}, {6.4, 52}, {11, 54.5}, {11, 56.6}, {7.4, 58.6}, {7, 61}});
  extend(profile, {{8.6, 68}, {11.4, 76}, {9.6, 76.6}, {7, 75.4}, {4, 78}, {2, 79}});
  extend(profile, ball(2.9, 81.4, 0.9, 5));
  Mesh mesh = lathe(profile, segments);
  for (int k = 0; k < 8; ++k) append(mesh, sphere(1.7, 8, 6), turned_y(2 * pi * k / 8) * moved({10.4, 76.8, 0}));
  return in_metres(mesh);
}

Mesh chess_king() {
  Profile profile = foot(19);
  extend(profile, {{11, 17}, {9, 27}, {7.4, 42}, {7, 58}, {11.8, 60.4}, {11.8, 62.8}, {8, 65}, {7.6, 68}});
  extend(profile, {{9, 76}, {11, 83}, {9.5, 84.4}, {5, 86.6}, {2.4, 88}, {2.2, 89.6}, {0, 90}});
  Mesh mesh = lathe(profile, segments);
  const Polygon cross = {{-1.2, 88.5}, {1.2, 88.5},  {1.1, 92.6}, {4.4, 92},    {4.4, 95.6}, {1.1, 95},
                         {1.6, 99.4},  {-1.6, 99.4}, {-1.1, 95},  {-4.4, 95.6}, {-4.4, 92},  {-1.1, 92.6}};
  append(mesh, extrude(cross, -1.3, 1.3, 0.4), turned_y(pi / 2));
  return in_metres(mesh);
}

}  // namespace shadewright::builtin
