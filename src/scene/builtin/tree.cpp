#include "scene/builtin/tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/sweep.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;

glm::dvec3 random_direction(Random& random) {
  const double y = random.range(-1, 1), angle = random.angle(), r = std::sqrt(1 - y * y);
  return {r * std::cos(angle), y, r * std::sin(angle)};
}

Path bent(const glm::dvec3& a, const glm::dvec3& b, double bend, Random& random) {
  const glm::dvec3 middle = 0.5 * (a + b) + bend * glm::length(b - a) * random_direction(random);
  return smooth_path(std::array{a, middle, b}, 2);
}

}  // namespace

Mesh leaf(const glm::dvec3& base, const glm::dvec3& direction, const glm::dvec3& side, double length, double width) {
  const glm::dvec3 d = glm::normalize(direction), s = glm::normalize(side - glm::dot(side, d) * d);
  const glm::dvec3 up = glm::cross(s, d);
  const glm::dvec3 middle = base + 0.55 * length * d - 0.06 * length * up;
  Mesh mesh;
  for (const glm::dvec3& p : {base, middle + 0.5 * width * s, base + length * d, middle - 0.5 * width * s})
    mesh.positions.emplace_back(glm::vec3(p));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  return mesh;
}

Mesh leaf_sheet(const glm::dvec3& base, const glm::dvec3& direction, const glm::dvec3& side, double length,
                double width) {
  Mesh mesh = leaf(base, direction, side, length, width);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  // Bent along the rib instead of across, or both triangles would lie in one plane.
  mesh.positions[2] += 0.1f * (mesh.positions[2] - mesh.positions[0]);
  return mesh;
}

Mesh lump(const glm::dvec3& center, const glm::dvec3& radii, uint32_t segments, uint32_t rings, double roughness,
          Random& random) {
  Mesh mesh = sphere(1.0, segments, rings);
  for (glm::vec3& p : mesh.positions) {
    const double factor = 1 + roughness * random.range(-1, 1);
    p = glm::vec3(center + radii * factor * glm::dvec3(p));
  }
  return mesh;
}

Prop broadleaf_tree(Scene& scene, const TreeShape& shape, Random& random) {
  Prop tree;
  tree.name = "tree";
  const bool fine = shape.crown != Crown::lumps;
  const auto make_leaf = shape.crown == Crown::sheets ? leaf_sheet : leaf;
  const double fork = shape.height * random.range(0.3, 0.38), girth = 0.03 * shape.height;
  const glm::dvec3 top(random.range(-0.1, 0.1) * shape.height, shape.height * 0.78,
                       random.range(-0.1, 0.1) * shape.height);
  const glm::dvec3 middle(0, fork, 0);
  Mesh wood = tapered_tube(
      smooth_path(std::array{glm::dvec3(0, -0.2, 0), glm::dvec3(0.05 * girth, 0.25 * fork, 0), middle, top}, 2), girth,
      0.12 * girth, fine ? 8 : 6);
  const glm::dvec3 heart(0, 0.5 * (fork + shape.height), 0);
  std::vector<Path> branches;
  const int count = fine ? 9 : 3;
  for (int k = 0; k < count; ++k) {
    const double t = double(k) / count, angle = 2.4 * k + random.range(-0.3, 0.3);
    const glm::dvec3 from = glm::mix(middle, top, 0.75 * t);
    const glm::dvec3 to =
        from + glm::dvec3(shape.spread * (0.95 - 0.5 * t) * std::cos(angle), shape.height * random.range(0.12, 0.26),
                          shape.spread * (0.95 - 0.5 * t) * std::sin(angle));
    branches.push_back(bent(from, to, 0.12, random));
    append(wood, tapered_tube(branches.back(), girth * (0.5 - 0.25 * t), 0.08 * girth, fine ? 5 : 4));
  }
  add_part(scene, tree, std::move(wood), color(0x6E5540));

  Mesh crown;
  if (!fine) {
    for (int k = 0; k < 4; ++k) {
      const glm::dvec3 at = k < 3 ? branches[static_cast<size_t>(k)].back() : top;
      const double r = shape.spread * random.range(0.52, 0.72);
      append(crown, lump(at + glm::dvec3(0, 0.25 * r, 0), {r, 0.8 * r, r}, 7, 5, 0.13, random));
    }
  } else {
    for (uint32_t k = 0; k < shape.leaf_count; ++k) {
      const Path& branch = branches[random.index(static_cast<uint32_t>(branches.size()))];
      const glm::dvec3 at = branch[1 + random.index(static_cast<uint32_t>(branch.size() - 1))];
      // Leaves crowd towards the outside of the clump round their branch.
      const glm::dvec3 out = random_direction(random);
      const glm::dvec3 base = at + out * shape.spread * (0.12 + 0.36 * std::sqrt(random.unit()));
      append(crown, make_leaf(base, out + glm::dvec3(0, -0.6, 0), random_direction(random) + 0.01,
                              shape.leaf_size * random.range(0.8, 1.25), shape.leaf_size * 0.62));
    }
  }
  add_part(scene, tree, std::move(crown), color(0x6F9A45), true);
  return tree;
}

Prop conifer(Scene& scene, const TreeShape& shape, Random& random) {
  Prop tree;
  tree.name = "fir";
  const bool fine = shape.crown != Crown::lumps;
  const auto make_leaf = shape.crown == Crown::sheets ? leaf_sheet : leaf;
  const double girth = 0.022 * shape.height;
  add_part(scene, tree,
           tapered_tube(std::array{glm::dvec3(0, -0.2, 0), glm::dvec3(0, shape.height * 0.5, 0),
                                   glm::dvec3(0, shape.height * 0.97, 0)},
                        girth, 0.1 * girth, 6),
           color(0x6A4E3A));
  Mesh crown;
  if (!fine) {
    constexpr int tiers = 5;
    for (int k = 0; k < tiers; ++k) {
      const double t = double(k) / tiers, y = shape.height * (0.16 + 0.7 * t), r = shape.spread * (1 - 0.8 * t);
      const Profile tier = {{0.15 * r, y + 0.03 * shape.height},
                            {r, y},
                            {0.55 * r, y + 0.09 * shape.height},
                            {0, y + 0.25 * shape.height}};
      Mesh mesh = lathe(tier, 9);
      append(crown, mesh, turned_y(random.angle()));
    }
  } else {
    const uint32_t twigs = std::max(12u, shape.leaf_count / 14);
    for (uint32_t k = 0; k < twigs; ++k) {
      const double t = (k + random.unit()) / twigs, y = shape.height * (0.14 + 0.83 * t);
      const double reach = shape.spread * (1.03 - t) * random.range(0.8, 1.1), angle = 2.399963 * k;
      const glm::dvec3 out(std::cos(angle), 0, std::sin(angle)), side(-out.z, 0, out.x);
      for (int i = 0; i < 14; ++i) {
        const double s = (i / 2 + 1) / 7.0, flip = i % 2 ? 1.0 : -1.0;
        const glm::dvec3 at = glm::dvec3(0, y, 0) + out * reach * s + glm::dvec3(0, -0.35 * reach * s * s, 0);
        append(crown, make_leaf(at - out * 0.2 * reach, 0.9 * out + 0.7 * flip * side + glm::dvec3(0, -0.3, 0),
                                glm::dvec3(0.1, 1, 0.07) + 0.6 * side,
                                1.5 * shape.leaf_size * (1.15 - 0.5 * s) + 0.15 * reach, shape.leaf_size * 0.5));
      }
    }
  }
  add_part(scene, tree, std::move(crown), color(0x3F6B4A), true);
  return tree;
}

Prop bush(Scene& scene, double radius, const glm::vec3& albedo, Random& random) {
  Prop prop;
  prop.name = "bush";
  Mesh mesh;
  for (int k = 0; k < 3; ++k) {
    const double a = 2 * pi * k / 3 + random.unit(), r = radius * random.range(0.55, 0.7);
    append(mesh, lump({0.45 * radius * std::cos(a), 0.55 * r, 0.45 * radius * std::sin(a)}, {r, 0.85 * r, r}, 8, 5,
                      0.12, random));
  }
  add_part(scene, prop, std::move(mesh), albedo, true);
  return prop;
}

}  // namespace shadewright::builtin
