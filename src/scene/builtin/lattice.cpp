// One closed body of high genus, a cage of thin curved struts, on a plinth (SPSM's YeahRight): struts join in nodes as
// one surface, by Catmull-Clark from a coarse cage of boxes.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "scene/builtin/noise.h"
#include "scene/builtin/random.h"
#include "scene/builtin/scenes.h"
#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/subdivide.h"
#include "scene/builtin/stage.h"

namespace shadewright::builtin {
namespace {

constexpr int nodes_per_side = 6;
constexpr int strut_count = 252;
constexpr int rings_per_strut = 3;       // between its two nodes
constexpr double half_thickness = 0.17;  // of a node's box, in units of the nodes' spacing

struct Strut {
  glm::ivec3 from;
  int axis = 0;
};

uint32_t node_index(const glm::ivec3& n) {
  return static_cast<uint32_t>((n.z * nodes_per_side + n.y) * nodes_per_side + n.x);
}

/// A connected choice of struts: a random spanning tree first, then more until there are enough.
std::vector<Strut> choose_struts(Random& random) {
  std::vector<Strut> all;
  for (int z = 0; z < nodes_per_side; ++z)
    for (int y = 0; y < nodes_per_side; ++y)
      for (int x = 0; x < nodes_per_side; ++x)
        for (int axis = 0; axis < 3; ++axis)
          if (glm::ivec3(x, y, z)[axis] + 1 < nodes_per_side) all.push_back({{x, y, z}, axis});
  for (size_t i = all.size() - 1; i > 0; --i) std::swap(all[i], all[random.index(static_cast<uint32_t>(i + 1))]);

  std::vector<uint32_t> group(nodes_per_side * nodes_per_side * nodes_per_side);
  std::iota(group.begin(), group.end(), 0u);
  const auto root = [&](uint32_t n) {
    while (group[n] != n) n = group[n] = group[group[n]];
    return n;
  };
  std::vector<Strut> chosen, others;
  for (const Strut& strut : all) {
    glm::ivec3 to = strut.from;
    ++to[strut.axis];
    const uint32_t a = root(node_index(strut.from)), b = root(node_index(to));
    (a == b ? others : chosen).push_back(strut);
    group[a] = b;
  }
  for (size_t i = 0; chosen.size() < strut_count; ++i) chosen.push_back(others[i]);
  return chosen;
}

/// The four corners of a box's face towards `direction` (0, 1 = -x, +x, ...), counter-clockwise seen from outside;
/// corners are numbered by bits: 1 = +x, 2 = +y, 4 = +z.
std::array<uint32_t, 4> face_corners(int direction) {
  constexpr std::array<std::array<uint32_t, 4>, 6> corners = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  return corners[static_cast<size_t>(direction)];
}

/// The cage in units of the nodes' spacing: a small box per node, joined by tubes of quadrilaterals.
QuadMesh make_cage(Random& random) {
  QuadMesh cage;
  constexpr int count = nodes_per_side * nodes_per_side * nodes_per_side;
  for (int n = 0; n < count; ++n) {
    const glm::dvec3 center(n % nodes_per_side, n / nodes_per_side % nodes_per_side,
                            n / (nodes_per_side * nodes_per_side));
    for (int c = 0; c < 8; ++c)
      cage.positions.push_back(center + half_thickness * glm::dvec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1));
  }
  std::vector<std::array<bool, 6>> joined(count, std::array<bool, 6>{});
  for (const Strut& strut : choose_struts(random)) {
    glm::ivec3 to = strut.from;
    ++to[strut.axis];
    const uint32_t a = node_index(strut.from), b = node_index(to);
    joined[a][static_cast<size_t>(2 * strut.axis + 1)] = joined[b][static_cast<size_t>(2 * strut.axis)] = true;
    // The face of a towards b, and the same corners on b's side, ring by ring.
    const std::array<uint32_t, 4> corners = face_corners(2 * strut.axis + 1);
    std::array<uint32_t, 4> ring{}, far{};
    for (size_t k = 0; k < 4; ++k) {
      ring[k] = 8 * a + corners[k];
      far[k] = 8 * b + (corners[k] & ~(1u << strut.axis));
    }
    const glm::dvec3 middle =
        0.5 *
        (0.25 *
             (cage.positions[ring[0]] + cage.positions[ring[1]] + cage.positions[ring[2]] + cage.positions[ring[3]]) +
         0.25 * (cage.positions[far[0]] + cage.positions[far[1]] + cage.positions[far[2]] + cage.positions[far[3]]));
    const std::array<uint32_t, 4> start = ring;
    for (int r = 1; r <= rings_per_strut + 1; ++r) {
      std::array<uint32_t, 4> next = far;
      if (r <= rings_per_strut) {
        const double t = double(r) / (rings_per_strut + 1), waist = 0.42 + 0.9 * (t - 0.5) * (t - 0.5);
        for (size_t k = 0; k < 4; ++k) {
          const glm::dvec3 p = glm::mix(cage.positions[start[k]], cage.positions[far[k]], t);
          glm::dvec3 axis_point = middle;
          axis_point[strut.axis] = p[strut.axis];
          next[k] = static_cast<uint32_t>(cage.positions.size());
          cage.positions.push_back(axis_point + waist * (p - axis_point));
        }
      }
      for (size_t k = 0; k < 4; ++k) cage.quads.push_back({ring[k], ring[(k + 1) % 4], next[(k + 1) % 4], next[k]});
      ring = next;
    }
  }
  for (uint32_t n = 0; n < count; ++n) {
    for (int direction = 0; direction < 6; ++direction) {
      if (joined[n][static_cast<size_t>(direction)]) continue;
      std::array<uint32_t, 4> quad = face_corners(direction);
      for (uint32_t& corner : quad) corner += 8 * n;
      cage.quads.push_back(quad);
    }
  }
  return cage;
}

/// Bends the regular cage: bulged towards a ball, turned about its axis, and swayed by noise.
glm::dvec3 bend(const glm::dvec3& grid) {
  glm::dvec3 p = grid * (2.0 / (nodes_per_side - 1)) - 1.0;
  const glm::dvec3 q = 1.25 * p;
  p += 0.3 * glm::dvec3(noise(q.x + 3, q.y, q.z, 1), noise(q.x, q.y + 5, q.z, 2), noise(q.x, q.y, q.z + 7, 3));
  const double cube = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), length = glm::length(p);
  if (length > 1e-9) p *= glm::mix(1.0, 1.25 * cube / length, 0.75);
  const double turn = 0.7 * p.y, c = std::cos(turn), s = std::sin(turn);
  return {c * p.x + s * p.z, p.y, -s * p.x + c * p.z};
}

}  // namespace

BuiltinScene lattice() {
  BuiltinScene entry;
  entry.name = "lattice";
  entry.help = "one closed body of high genus made of thin curved struts, 155k triangles (SPSM YeahRight)";
  entry.make = [](const BuiltinValues&) {
    Scene scene;
    scene.name = "lattice";
    Random random(155);
    QuadMesh body = make_cage(random);
    for (glm::dvec3& p : body.positions) p = 0.6 * bend(p);
    body = subdivide(subdivide(body));
    double lowest = 0;
    for (const glm::dvec3& p : body.positions) lowest = std::min(lowest, p.y);
    place(scene, "lattice", transformed(to_triangles(body), moved({0, 0.196 - lowest, 0})), color(0xC98A4B));
    const Profile plinth = {{0.78, -0.02}, {0.8, 0.03}, {0.74, 0.08}, {0.7, 0.18}, {0.69, 0.2}, {0, 0.2}};
    place(scene, "plinth", lathe(plinth, 64), color(0x8F9296));
    place(scene, "floor", slab({-4, -0.3, -4}, {4, 0, 4}, 0.02), color(0xC9C5BA));
    add_camera(scene, "main", {1.3, 1.7, 2.9}, {0.1, 0.8, 0.0}, 42);
    add_camera(scene, "near", {0.5, 1.25, 1.35}, {-0.05, 0.8, 0.1}, 40);
    add_sun(scene, 152, 42);
    return scene;
  };
  return entry;
}

}  // namespace shadewright::builtin
