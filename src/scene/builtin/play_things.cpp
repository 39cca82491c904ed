#include "scene/builtin/play_things.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/loft.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/sweep.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr uint32_t bar_sides = 12;

/// One link of a chain about the origin, long axis along Y.
Mesh chain_link() {
  Path loop;
  constexpr int steps = 8;
  for (int i = 0; i <= steps; ++i)
    loop.emplace_back(0.011 * std::cos(pi * i / steps), 0.012 + 0.011 * std::sin(pi * i / steps), 0.0);
  for (int i = 0; i <= steps; ++i)
    loop.emplace_back(-0.011 * std::cos(pi * i / steps), -0.012 - 0.011 * std::sin(pi * i / steps), 0.0);
  return tube(loop, 0.0042, 7, Ends::joined);
}

/// Links from `a` to `b`, each turned a quarter against the one before.
void add_chain(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b) {
  const Mesh link = chain_link();
  constexpr double pitch = 0.0375;
  const int count = static_cast<int>(glm::length(b - a) / pitch);
  for (int k = 0; k <= count; ++k)
    append(mesh, link, along(glm::mix(a, b, double(k) / count), b - a) * turned_y(k % 2 ? pi / 2 : 0));
}

/// Reaches a few millimetres past its ends, further past `b`: bars that meet end to end in a joint then share no
/// corner, and each stays a closed body of its own.
Mesh bar(const glm::dvec3& a, const glm::dvec3& b, double radius = 0.019) {
  const glm::dvec3 axis = glm::normalize(b - a);
  return rod(a - 0.003 * axis, b + 0.005 * axis, radius, bar_sides);
}

}  // namespace

Prop swings(Scene& scene) {
  Prop prop;
  prop.name = "swings";
  Mesh frame = bar({-2.6, 2.4, 0}, {2.6, 2.4, 0}, 0.045), chains, seats;
  for (const double x : {-2.5, 2.5})
    for (const double z : {-0.95, 0.95}) append(frame, bar({x * 1.08, -0.05, z}, {x, 2.42, 0}, 0.04));
  for (const double x : {-2.62, 2.62}) append(frame, bar({x, 1.0, -0.58}, {x, 1.0, 0.58}, 0.025));
  const double angle[] = {0.5, -0.15};
  for (int k = 0; k < 2; ++k) {
    const double x = k ? 1.1 : -1.1, reach = 1.85;
    const glm::dvec3 drop(0, -reach * std::cos(angle[k]), reach * std::sin(angle[k]));
    for (const double side : {-0.24, 0.24}) {
      const glm::dvec3 top(x + side, 2.36, 0);
      add_chain(chains, top, top + drop);
      append(chains, torus(0.05, 0.008, 16, 8), moved({x + side, 2.4, 0}) * turned_z(pi / 2));
    }
    append(seats, slab({-0.27, -0.03, -0.09}, {0.27, 0.0, 0.09}, 0.008),
           moved(glm::dvec3(x, 2.35, 0) + drop) * turned_x(-angle[k]));
  }
  add_part(scene, prop, std::move(frame), color(0x3F7CAC), true);
  add_part(scene, prop, std::move(chains), color(0xA8ACB0));
  add_part(scene, prop, std::move(seats), color(0x3A3836));
  return prop;
}

Prop climbing_cube(Scene& scene, int nx, int ny, int nz) {
  Prop prop;
  prop.name = "climbing frame";
  constexpr double cell = 0.5;
  Mesh bars, joints;
  const auto at = [&](int i, int j, int k) {
    return glm::dvec3(cell * (i - 0.5 * nx), cell * j + (j ? 0.0 : -0.05), cell * (k - 0.5 * nz));
  };
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        // A stair of cells towards one side, so that the frame has an outline.
        const auto present = [&](int a, int b, int c) {
          return b <= ny - std::max(0, a - nx / 2) && b <= ny - std::max(0, nz / 2 - 1 - c);
        };
        if (!present(i, j, k)) continue;
        if (i < nx && j > 0 && present(i + 1, j, k)) append(bars, bar(at(i, j, k), at(i + 1, j, k)));
        if (j < ny && present(i, j + 1, k)) append(bars, bar(at(i, j, k), at(i, j + 1, k)));
        if (k < nz && j > 0 && present(i, j, k + 1)) append(bars, bar(at(i, j, k), at(i, j, k + 1)));
        if (j > 0) append(joints, sphere(0.034, 12, 8), moved(at(i, j, k)));
      }
    }
  }
  add_part(scene, prop, std::move(bars), color(0xD9A441), true);
  add_part(scene, prop, std::move(joints), color(0x4A4F52));
  return prop;
}

Prop climbing_dome(Scene& scene, double radius) {
  Prop prop;
  prop.name = "climbing dome";
  Mesh bars, joints;
  // Rings of points, each turned half a step against the one below; neighbours are joined to triangles.
  constexpr int around = 14, rings = 5;
  const auto at = [&](int i, int j) {
    const double rise = 0.5 * pi * j / (rings + 0.6), angle = 2 * pi * (i + 0.5 * j) / around;
    return radius * glm::dvec3(std::cos(rise) * std::cos(angle), std::sin(rise) - (j ? 0.0 : 0.02),
                               std::cos(rise) * std::sin(angle));
  };
  for (int j = 0; j <= rings; ++j) {
    for (int i = 0; i < around; ++i) {
      if (j > 0) append(bars, bar(at(i, j), at(i + 1, j), 0.016));
      if (j < rings) {
        append(bars, bar(at(i, j), at(i, j + 1), 0.016));
        append(bars, bar(at(i + 1, j), at(i, j + 1), 0.016));
      }
      if (j > 0) append(joints, sphere(0.03, 12, 8), moved(at(i, j)));
    }
  }
  add_part(scene, prop, std::move(bars), color(0xC9573F), true);
  add_part(scene, prop, std::move(joints), color(0x4A4F52));
  return prop;
}

Prop rope_pyramid(Scene& scene) {
  Prop prop;
  prop.name = "rope pyramid";
  constexpr double height = 4.2, radius = 3.1;
  constexpr int around = 16, rings = 13;
  Mesh ropes, mast = bar({0, -0.1, 0}, {0, height + 0.25, 0}, 0.07);
  append(mast, sphere(0.13, 20, 12), moved({0, height + 0.3, 0}));
  const auto at = [&](double i, double t) {
    const double angle = 2 * pi * i / around, r = radius * (1 - t) * (1 - 0.35 * t) + 0.06;
    return glm::dvec3(r * std::cos(angle), -0.05 + t * height, r * std::sin(angle));
  };
  for (int i = 0; i < around; ++i) {
    Path up;
    for (int j = 0; j <= rings; ++j) up.push_back(at(i, double(j) / rings));
    append(ropes, tube(up, 0.011, 9));
    for (int j = 1; j < rings; ++j) {
      // Ropes between the stays hang through a little.
      const double t = double(j) / rings;
      const glm::dvec3 a = at(i, t), b = at(i + 1, t), sag(0, -0.06 * (1 - t), 0);
      append(ropes, tube(std::array{a, 0.5 * (a + b) + 0.9 * sag, b}, 0.009, 8));
    }
  }
  // The inner net: spokes at three heights.
  for (const double t : {0.25, 0.45, 0.65})
    for (int i = 0; i < around; i += 2)
      append(ropes, tube(std::array{at(i, t), 0.5 * at(i, t) + glm::dvec3(0, 0.5 * at(i, t).y - 0.1, 0),
                                    glm::dvec3(0.01 * at(i, t).x, at(i, t).y + 0.15, 0.01 * at(i, t).z)},
                         0.01, 8));
  add_part(scene, prop, std::move(mast), color(0x8C9094));
  add_part(scene, prop, std::move(ropes), color(0xB5563F), true);
  return prop;
}

Prop slide(Scene& scene) {
  Prop prop;
  prop.name = "slide";
  constexpr double top = 2.1;
  Mesh frame, chute, boards;
  for (const double z : {-0.45, 0.45}) {
    for (const double x : {-1.0, 0.0}) append(frame, bar({x, -0.05, z}, {x, top + 0.95, z}, 0.035));
    append(frame, bar({-1, top + 0.93, z}, {0, top + 0.93, z}, 0.028));
    for (int k = 1; k < 9; ++k)
      append(frame, bar({-1 + 0.11 * k, top - 0.05, z}, {-1 + 0.11 * k, top + 0.93, z}, 0.011));
    append(frame, bar({-1.75, -0.05, z * 0.8}, {-0.98, top + 0.3, z * 0.8}, 0.03));
  }
  for (int k = 1; k < 9; ++k)
    append(frame, bar({-1.75 + 0.73 * k / 8.6, 0.24 * k, -0.38}, {-1.75 + 0.73 * k / 8.6, 0.24 * k, 0.38}, 0.017));
  append(boards, slab({-1.05, top - 0.06, -0.5}, {0.05, top, 0.5}, 0.01));
  // The chute: a gutter of sheet metal carried down a curve.
  std::vector<glm::dvec2> gutter;
  const auto profile = [](double u) { return glm::dvec2(0.28 * u, 0.2 * std::pow(std::abs(u), 4.0)); };
  constexpr int steps = 12;
  for (int i = 0; i <= steps; ++i) gutter.push_back(profile(-1 + 2.0 * i / steps) - glm::dvec2(0, 0.014));
  for (int i = steps; i >= 0; --i) gutter.push_back(profile(-1 + 2.0 * i / steps) + glm::dvec2(0, 0.0));
  const Path way =
      smooth_path(std::array{glm::dvec3(-0.1, top + 0.03, 0), glm::dvec3(0.25, top, 0), glm::dvec3(1.2, 1.25, 0),
                             glm::dvec3(2.2, 0.48, 0), glm::dvec3(2.9, 0.3, 0), glm::dvec3(3.3, 0.3, 0)},
                  7);
  append(chute, sweep(gutter, way, Sizes(way.size(), glm::dvec2(1))));
  append(frame, bar({3.1, -0.05, 0}, {3.1, 0.3, 0}, 0.04));
  add_part(scene, prop, std::move(frame), color(0x4E8F5A), true);
  add_part(scene, prop, std::move(chute), color(0xB9BEC4));
  add_part(scene, prop, std::move(boards), color(0xA98252));
  return prop;
}

Prop seesaw(Scene& scene) {
  Prop prop;
  prop.name = "seesaw";
  Mesh stand, plank;
  for (const double z : {-0.22, 0.22})
    for (const double x : {-0.3, 0.3}) append(stand, bar({x, -0.05, z}, {0, 0.62, z}, 0.03));
  append(stand, bar({0, 0.62, -0.28}, {0, 0.62, 0.28}, 0.04));
  const glm::dmat4 tilt = moved({0, 0.66, 0}) * turned_z(0.2);
  append(plank, slab({-1.9, -0.03, -0.14}, {1.9, 0.03, 0.14}, 0.01), tilt);
  for (const double x : {-1.45, 1.45}) {
    for (const double z : {-0.1, 0.1}) append(stand, bar({x, 0, z}, {x, 0.36, z}, 0.014), tilt);
    append(stand, bar({x, 0.36, -0.2}, {x, 0.36, 0.2}, 0.017), tilt);
  }
  add_part(scene, prop, std::move(stand), color(0x6B6F74));
  add_part(scene, prop, std::move(plank), color(0xC9573F), true);
  return prop;
}

Prop roundabout(Scene& scene) {
  Prop prop;
  prop.name = "roundabout";
  Mesh bars, disc = lathe(Profile{{1.2, 0.1}, {1.25, 0.12}, {1.25, 0.16}, {1.2, 0.18}, {0.1, 0.19}, {0, 0.19}}, 64);
  append(disc, cylinder(0.2, 0.25, 24), moved({0, -0.1, 0}));
  for (int k = 0; k < 8; ++k) {
    const double a = 2 * pi * k / 8;
    const auto at = [&](double r, double y) { return glm::dvec3(r * std::cos(a), y, r * std::sin(a)); };
    append(bars,
           tube(smooth_path(std::array{at(1.1, 0.15), at(1.12, 0.7), at(0.95, 0.95), at(0.4, 0.95), at(0.08, 0.9)}, 6),
                0.019, bar_sides));
  }
  append(bars, bar({0, 0.1, 0}, {0, 1.0, 0}, 0.06));
  append(bars, torus(0.62, 0.019, 64, 12), moved({0, 0.96, 0}));
  add_part(scene, prop, std::move(disc), color(0xD9A441), true);
  add_part(scene, prop, std::move(bars), color(0xA8ACB0));
  return prop;
}

Prop railing(Scene& scene, double length) {
  Prop prop;
  prop.name = "railing";
  Mesh mesh;
  for (const double y : {0.15, 1.0}) append(mesh, bar({-0.5 * length, y, 0}, {0.5 * length, y, 0}, 0.022));
  const int bars = static_cast<int>(length / 0.11);
  for (int k = 1; k < bars; ++k) {
    const double x = length * (double(k) / bars - 0.5);
    append(mesh, rod({x, 0.14, 0}, {x, 1.01, 0}, 0.009, 9));
  }
  // The post at the far end is slimmer: the next panel's stands around it.
  append(mesh, bar({-0.5 * length, -0.1, 0}, {-0.5 * length, 1.12, 0}, 0.035));
  append(mesh, sphere(0.05, 14, 8), moved({-0.5 * length, 1.14, 0}));
  append(mesh, bar({0.5 * length, -0.09, 0}, {0.5 * length, 1.08, 0}, 0.031));
  add_part(scene, prop, std::move(mesh), color(0x3E5A4C));
  return prop;
}

}  // namespace shadewright::builtin
