#include "scene/builtin/plants.h"

#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/sweep.h"
#include "scene/builtin/tree.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;

glm::dvec3 heading(double angle, double rise = 0) {
  return {std::cos(angle), rise, std::sin(angle)};
}
glm::dvec3 across(double angle) {
  return {-std::sin(angle), 0.02, std::cos(angle)};
}

}  // namespace

Prop grass_tuft(Scene& scene, Random& random) {
  Prop prop;
  prop.name = "grass";
  Mesh mesh;
  const uint32_t blades = 30 + random.index(50);
  const double height = random.range(0.15, 0.6), spread = random.range(0.08, 0.3);
  for (uint32_t k = 0; k < blades; ++k) {
    const double angle = random.angle(), out = spread * std::sqrt(random.unit()), turn = random.angle();
    const glm::dvec3 base = out * heading(angle) - glm::dvec3(0, 0.02, 0);
    append(mesh, leaf_sheet(base, heading(turn, random.range(1.2, 3.5)), across(turn), height * random.range(0.6, 1.2),
                            random.range(0.008, 0.02)));
  }
  add_part(scene, prop, std::move(mesh), color(0x7F9A45), true);
  return prop;
}

Prop flower(Scene& scene, Random& random) {
  Prop prop;
  prop.name = "flower";
  Mesh green, petals;
  const uint32_t stems = 1 + random.index(4), count = 5 + random.index(9);
  const double height = random.range(0.2, 0.8), size = random.range(0.03, 0.09), droop = random.range(-0.3, 0.8);
  for (uint32_t s = 0; s < stems; ++s) {
    const double angle = random.angle();
    const glm::dvec3 top = height * random.range(0.8, 1.1) * glm::normalize(heading(angle, random.range(3, 9)));
    append(green,
           tapered_tube(std::array{glm::dvec3(0, -0.02, 0), glm::dvec3(0.3 * top.x, 0.5 * top.y, 0.3 * top.z), top},
                        0.006, 0.004, 3));
    for (int k = 0; k < 4; ++k) {
      const double turn = random.angle();
      append(green, leaf_sheet(glm::mix(glm::dvec3(0), top, random.range(0.05, 0.7)), heading(turn, 0.6), across(turn),
                               0.3 * height, 0.05 + 0.04 * height));
    }
    for (uint32_t k = 0; k < count; ++k) {
      const double turn = 2 * pi * k / count;
      append(petals, leaf_sheet(top, heading(turn, droop), across(turn), size, 3.5 * size / count + 0.01));
    }
    append(petals, sphere(0.22 * size, 6, 4), moved(top + glm::dvec3(0, 0.1 * size, 0)));
  }
  constexpr std::array<uint32_t, 7> blossoms = {0xE8D24A, 0xD9573F, 0xE9E4F0, 0x8A6AC0, 0xD98AB0, 0xE8963D, 0x6A8AD0};
  add_part(scene, prop, std::move(green), color(0x6B8F48), true);
  add_part(scene, prop, std::move(petals), color(blossoms[random.index(7)]));
  return prop;
}

Prop fern(Scene& scene, Random& random) {
  Prop prop;
  prop.name = "fern";
  Mesh mesh;
  const uint32_t fronds = 7 + random.index(7);
  const int pairs = 10 + static_cast<int>(random.index(9));
  const double length = random.range(0.5, 1.3), lift = random.range(0.7, 1.3), width = random.range(0.16, 0.3);
  for (uint32_t f = 0; f < fronds; ++f) {
    const double angle = 2 * pi * f / fronds + random.range(-0.2, 0.2), reach = length * random.range(0.8, 1.1);
    const auto rib = [&](double t) {
      return reach * (t * heading(angle) * 0.8 + glm::dvec3(0, lift * t * (1 - 0.75 * t), 0));
    };
    Path path;
    for (int i = 0; i <= 4; ++i) path.push_back(rib(i / 4.0) - glm::dvec3(0, i == 0 ? 0.02 : 0.0, 0));
    append(mesh, tapered_tube(path, 0.007, 0.002, 3));
    for (int k = 0; k < pairs; ++k) {
      const double t = 0.12 + 0.86 * k / pairs, size = width * reach * std::sin(pi * (0.12 + 0.84 * t)) + 0.01;
      for (const double side : {-1.0, 1.0})
        append(mesh, leaf_sheet(rib(t), side * across(angle) + 0.5 * heading(angle), heading(angle, -0.3), size,
                                1.7 * reach / pairs * 0.5));
    }
  }
  add_part(scene, prop, std::move(mesh), color(0x4F7F3F), true);
  return prop;
}

Prop shrub(Scene& scene, Random& random) {
  Prop prop;
  prop.name = "shrub";
  Mesh wood, leaves;
  const double height = random.range(0.6, 2.2), spread = height * random.range(0.35, 0.7),
               size = random.range(0.06, 0.16);
  const int stems = 5 + static_cast<int>(random.index(4));
  std::vector<glm::dvec3> tips;
  for (int s = 0; s < stems; ++s) {
    const double angle = 2 * pi * s / stems + random.range(-0.3, 0.3);
    const glm::dvec3 tip =
        random.range(0.3, 0.8) * spread * heading(angle) + glm::dvec3(0, height * random.range(0.55, 0.85), 0);
    append(wood, tapered_tube(std::array{glm::dvec3(0.03 * std::cos(angle), -0.05, 0.03 * std::sin(angle)),
                                         glm::dvec3(0.3 * tip.x, 0.55 * tip.y, 0.3 * tip.z), tip},
                              0.02 * height, 0.005 * height, 4));
    tips.push_back(tip);
  }
  const uint32_t count = 150 + random.index(180);
  for (uint32_t k = 0; k < count; ++k) {
    const double turn = random.angle(), rise = random.range(-0.8, 1);
    const glm::dvec3 away = random.range(0.25, 1) * 0.5 * spread * glm::normalize(heading(turn, rise));
    append(leaves, leaf_sheet(tips[random.index(static_cast<uint32_t>(tips.size()))] * random.range(0.6, 1.05) + away,
                              heading(turn, rise - 0.3), across(turn), size * random.range(0.8, 1.3), 0.55 * size));
  }
  add_part(scene, prop, std::move(wood), color(0x6A5440));
  add_part(scene, prop, std::move(leaves), color(0x5F8A45), true);
  return prop;
}

Prop mushroom(Scene& scene, Random& random) {
  Prop prop;
  prop.name = "mushroom";
  Mesh stalks, caps;
  const double size = random.range(0.05, 0.14), dome = random.range(0.3, 0.8);
  for (uint32_t k = 0; k < 3 + random.index(4); ++k) {
    const double grown = random.range(0.5, 1.1) * size, angle = random.angle();
    const glm::dmat4 at = moved(2.2 * size * random.unit() * heading(angle)) * turned_x(random.range(-0.15, 0.15));
    append(stalks, lathe(Profile{{0.3 * grown, -0.02}, {0.2 * grown, 0.5 * grown}, {0.18 * grown, 1.25 * grown}}, 8),
           at);
    append(caps,
           lathe(Profile{{0, 1.1 * grown},
                         {0.8 * grown, 1.12 * grown},
                         {grown, 1.2 * grown},
                         {0.75 * grown, (1.2 + 0.7 * dome) * grown},
                         {0.35 * grown, (1.2 + dome) * grown},
                         {0, (1.25 + dome) * grown}},
                 12),
           at);
  }
  add_part(scene, prop, std::move(stalks), color(0xE3D9C3));
  add_part(scene, prop, std::move(caps), color(random.chance(0.5) ? 0xB4453A : 0x9A7450));
  return prop;
}

Prop cow(Scene& scene, Random& random) {
  Prop prop;
  prop.name = "cow";
  Mesh hide, horn;
  const Path back = {{-1.02, 1.1, 0}, {-0.97, 1.1, 0}, {-0.75, 1.08, 0}, {-0.3, 1.02, 0},
                     {0.2, 1.0, 0},   {0.6, 1.06, 0},  {0.85, 1.14, 0},  {0.95, 1.2, 0}};
  const Sizes girth = {{0.12, 0.14}, {0.24, 0.26}, {0.32, 0.34}, {0.38, 0.38},
                       {0.39, 0.4},  {0.32, 0.38}, {0.2, 0.28},  {0.1, 0.16}};
  append(hide, sweep(regular_polygon(20), back, girth));
  const double graze = random.range(0, 1);  // head down to the grass, or up
  const glm::dvec3 poll = glm::mix(glm::dvec3(1.25, 1.5, 0), glm::dvec3(1.4, 0.62, 0), graze),
                   muzzle = poll + glm::mix(glm::dvec3(0.42, -0.2, 0), glm::dvec3(0.22, -0.42, 0), graze);
  append(hide, sweep(regular_polygon(14),
                     smooth_path(
                         std::array{glm::dvec3(0.7, 1.15, 0), glm::dvec3(1.0, glm::mix(1.3, 1.05, graze), 0), poll}, 4),
                     [] {
                       Sizes s;
                       for (int i = 0; i <= 8; ++i) s.emplace_back(0.2 - 0.011 * i, 0.28 - 0.019 * i);
                       return s;
                     }()));
  append(hide, sweep(regular_polygon(14),
                     std::array{poll - 0.25 * (muzzle - poll), poll, glm::mix(poll, muzzle, 0.5),
                                glm::mix(poll, muzzle, 0.9), muzzle, muzzle + 0.06 * (muzzle - poll)},
                     Sizes{{0.06, 0.07}, {0.13, 0.14}, {0.1, 0.12}, {0.085, 0.085}, {0.08, 0.08}, {0.04, 0.04}}));
  for (const double z : {-1.0, 1.0}) {
    append(horn, tapered_tube(smooth_path(std::array{poll + glm::dvec3(-0.02, 0.1, 0.08 * z),
                                                     poll + glm::dvec3(0, 0.14, 0.22 * z),
                                                     poll + glm::dvec3(0.06, 0.26, 0.25 * z)},
                                          4),
                              0.028, 0.006, 9));
    append(hide, sphere(1, 10, 6),
           moved(poll + glm::dvec3(-0.04, 0.04, 0.19 * z)) * turned_x(-0.4 * z) * scaled({0.05, 0.03, 0.1}));
    for (const double x : {-0.78, 0.62}) {
      const double stride = random.range(-0.12, 0.12);
      append(hide, sweep(regular_polygon(10),
                         std::array{glm::dvec3(x, 1.0, 0.2 * z), glm::dvec3(x + 0.04, 0.75, 0.21 * z),
                                    glm::dvec3(x + 0.4 * stride, 0.45, 0.2 * z), glm::dvec3(x + stride, 0.1, 0.2 * z),
                                    glm::dvec3(x + stride + 0.02, -0.03, 0.2 * z)},
                         Sizes{{0.14, 0.18}, {0.11, 0.14}, {0.06, 0.07}, {0.045, 0.05}, {0.065, 0.075}}, {1, 0, 0}));
    }
  }
  append(hide, sphere(1, 14, 8), moved({-0.55, 0.68, 0}) * scaled({0.2, 0.12, 0.15}));
  append(hide, tapered_tube(smooth_path(std::array{glm::dvec3(-0.95, 1.35, 0), glm::dvec3(-1.1, 1.2, 0.02),
                                                   glm::dvec3(-1.12, 0.8, 0.03), glm::dvec3(-1.1, 0.5, 0)},
                                        4),
                            0.03, 0.012, 8));
  append(hide, sphere(1, 10, 6), moved({-1.1, 0.46, 0}) * scaled({0.04, 0.11, 0.04}));
  add_part(scene, prop, std::move(hide), color(0x8A5A3C), true);
  add_part(scene, prop, std::move(horn), color(0xE0D6C0));
  return prop;
}

}  // namespace shadewright::builtin
