// Toys in the sand under a low sun (the sandbox of RTW): a few detailed things on a plane, some very thin. All closed.
#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/scenes.h"
#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/extrude.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/loft.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/panel.h"
#include "scene/builtin/shapes/sweep.h"
#include "scene/builtin/stage.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;

void add_bucket(Scene& scene, const glm::dmat4& where) {
  const Profile wall = {{0.085, 0},     {0.092, 0.004}, {0.1, 0.07},   {0.112, 0.18},  {0.12, 0.184}, {0.121, 0.194},
                        {0.114, 0.196}, {0.108, 0.19},  {0.096, 0.07}, {0.088, 0.012}, {0, 0.01}};
  place(scene, "bucket", transformed(lathe(wall, 72), where), color(0xD2453A));
  Path bow;
  for (int i = 0; i <= 28; ++i) {
    const double a = pi * i / 28;
    bow.emplace_back(0.117 * std::cos(a), 0.18 + 0.13 * std::sin(a) * 0.72, 0.13 * std::sin(a) * 0.69);
  }
  Mesh handle = tube(bow, 0.0032, 8);
  for (const double side : {-1.0, 1.0})
    append(handle, cylinder(0.009, 0.012, 16), along({side * 0.112, 0.18, 0}, {side, 0, 0}));
  place(scene, "bucket handle", transformed(handle, where), color(0xE9E4D4));
}

/// A blade curved like a gutter, a shaft and a D-shaped grip; the blade's tip is at the origin, the shaft along +Y.
void add_spade(Scene& scene, const glm::dmat4& where) {
  std::vector<Ring> rings;
  constexpr int across = 14, lengthways = 12;
  for (int k = 0; k <= lengthways; ++k) {
    const double t = double(k) / lengthways;
    const double half = 0.07 * std::sqrt(1 - std::pow(1 - std::min(1.0, t * 1.6 + 0.04), 2.0)) * (1 - 0.12 * t);
    const double y = 0.19 * t;
    Ring ring;
    const auto arc = [&](double u, double lift) { return glm::dvec3(half * u, y, 0.022 * u * u - 0.01 * t + lift); };
    for (int i = 0; i <= across; ++i) ring.push_back(arc(1 - 2.0 * i / across, 0));
    for (int i = 0; i <= across; ++i) ring.push_back(arc(-1 + 2.0 * i / across, 0.004));
    rings.push_back(ring);
  }
  Mesh blade = loft(rings);
  append(blade,
         tapered_tube(std::array{glm::dvec3(0, 0.1, -0.002), glm::dvec3(0, 0.17, -0.006), glm::dvec3(0, 0.24, -0.008)},
                      0.008, 0.0135, 14));
  place(scene, "spade blade", transformed(blade, where), color(0x3F7CAC));
  Mesh shaft = rod({0, 0.2, -0.007}, {0, 0.5, -0.007}, 0.0105, 16);
  place(scene, "spade shaft", transformed(shaft, where), color(0xC99A62));
  Path grip;
  for (int i = 0; i < 32; ++i) {
    const double a = 2 * pi * i / 32;
    grip.emplace_back(0.05 * std::cos(a) * (0.8 - 0.2 * std::sin(a)), 0.535 - 0.042 * std::sin(a), -0.007);
  }
  place(scene, "spade grip", transformed(tube(grip, 0.009, 12, Ends::joined), where), color(0x3F7CAC));
}

/// The head across x at the origin, tines along +Y, the shaft along -Z.
void add_rake(Scene& scene, const glm::dmat4& where) {
  Mesh head = rod({-0.15, 0, 0}, {0.15, 0, 0}, 0.008, 12);
  constexpr int tines = 15;
  for (int k = 0; k < tines; ++k) {
    const double x = -0.14 + 0.28 * k / (tines - 1);
    Path path;
    for (int i = 0; i <= 10; ++i) {
      const double a = 1.25 * i / 10;
      path.emplace_back(x, 0.13 * std::sin(a), 0.1 * (1 - std::cos(a)));
    }
    append(head, tapered_tube(path, 0.0024, 0.0011, 7));
  }
  place(scene, "rake head", transformed(head, where), color(0x4E8F5A));
  Mesh shaft = rod({0, 0, 0.004}, {0, 0, -0.72}, 0.009, 14);
  append(shaft, sphere(0.0135, 14, 10), moved({0, 0, -0.72}));
  place(scene, "rake shaft", transformed(shaft, where), color(0xC99A62));
}

void add_ball(Scene& scene, const glm::dvec3& center, double radius) {
  const glm::dmat4 where = moved(center) * turned_z(0.5) * turned_x(0.4);
  place(scene, "ball", transformed(sphere(radius, 64, 38), where), color(0xE7E1D2));
  // Two painted bands, half a millimetre proud of the ball.
  for (const double sign : {-1.0, 1.0}) {
    Profile band;
    for (int i = 0; i <= 6; ++i) {
      const double a = sign * 0.42 - 0.16 + 0.32 * i / 6;
      band.emplace_back((radius + 0.0008) * std::cos(a), (radius + 0.0008) * std::sin(a));
    }
    for (int i = 1; i >= 0; --i) {
      const double a = sign * 0.42 - 0.16 + 0.32 * i;
      band.emplace_back((radius - 0.01) * std::cos(a), (radius - 0.01) * std::sin(a));
    }
    place(scene, "ball band", transformed(lathe_ring(band, 56), where), color(sign > 0 ? 0xE0A030 : 0x3F7CAC));
  }
}

/// Merlons round a tower's rim, sunk into it.
void add_merlons(Mesh& mesh, double radius, double y, int count, double height) {
  for (int k = 0; k < count; ++k) {
    const double a = 2 * pi * k / count, half = 0.28 * 2 * pi / count * radius;
    append(mesh, slab({-half, -0.003, -0.009}, {half, height, 0.009}, 0.002),
           turned_y(a) * moved({0, y, radius - 0.011}));
  }
}

Mesh tower(double radius, double height) {
  const Profile profile = {{radius * 1.22, -0.02},        {radius * 1.15, 0.02},          {radius, height * 0.4},
                           {radius * 0.97, height * 0.8}, {radius * 1.14, height * 0.86}, {radius * 1.14, height},
                           {radius * 0.86, height},       {radius * 0.84, height - 0.01}, {0, height - 0.012}};
  Mesh mesh = lathe(profile, 40);
  add_merlons(mesh, radius * 1.14, height, 11, 0.02);
  return mesh;
}

/// A curtain wall along x, 2 half long, with battlements and, if asked, a gate.
Mesh curtain(double half, double height, bool gate) {
  std::vector<double> xs, ys = {-0.02, 0.075, height, height + 0.02};
  constexpr int cells = 17;
  for (int i = 0; i <= cells; ++i) xs.push_back(half * (2.0 * i / cells - 1));
  return panel(xs, ys, -0.016, 0.016, [&](size_t i, size_t j) {
    if (j == 0) return !gate || i < 7 || i > 9;
    return j == 1 || i % 2 == 0;
  });
}

void add_castle(Scene& scene, const glm::dmat4& where) {
  const glm::vec3 sand = color(0xCFA96B);
  const Profile mound = {{0.52, -0.02}, {0.47, 0.004}, {0.4, 0.022}, {0.36, 0.028}, {0, 0.03}};
  place(scene, "castle mound", transformed(lathe(mound, 56), where), shade(sand, 0.95));
  const glm::dmat4 yard = where * moved({0, 0.028, 0});
  Mesh towers;
  for (const double x : {-0.22, 0.22})
    for (const double z : {-0.22, 0.22}) append(towers, tower(0.062, 0.21), moved({x, 0, z}));
  place(scene, "castle towers", transformed(towers, yard), shade(sand, 1.06));
  Mesh walls;
  for (int k = 0; k < 4; ++k) append(walls, curtain(0.18, 0.12, k == 0), turned_y(pi / 2 * k) * moved({0, 0, 0.22}));
  place(scene, "castle walls", transformed(walls, yard), sand);

  Mesh keep = tower(0.085, 0.3);
  place(scene, "castle keep", transformed(keep, yard), shade(sand, 1.1));
  place(scene, "castle roof", transformed(cone(0.078, 0, 0.13, 40), yard * moved({0, 0.27, 0})), color(0xB4553F));
  place(scene, "flagpole", transformed(rod({0, 0.37, 0}, {0, 0.54, 0}, 0.003, 8), yard), color(0xEDE6D6));
  std::vector<Ring> flag;
  for (int i = 0; i <= 12; ++i) {
    const double x = 0.002 + 0.1 * i / 12, z = 0.009 * std::sin(7.5 * i / 12.0) * i / 12,
                 half = 0.03 * (1 - 0.5 * i / 12);
    flag.push_back({{x, 0.5 - half, z - 0.0008},
                    {x, 0.5 + half, z - 0.0008},
                    {x, 0.5 + half, z + 0.0008},
                    {x, 0.5 - half, z + 0.0008}});
  }
  place(scene, "flag", transformed(loft(flag), yard), color(0xC8352E));
}

/// A round sieve: a rim and a grid of holes within it, lying in the plane y = 0.
void add_sieve(Scene& scene, const glm::dmat4& where) {
  const Profile rim = {{0.12, -0.025}, {0.126, 0.025}, {0.121, 0.027}, {0.112, -0.027}};
  place(scene, "sieve rim", transformed(lathe_ring(rim, 56), where), color(0xE0A030));
  std::vector<double> lines;
  constexpr int holes = 13;
  for (int i = 0; i <= 2 * holes + 1; ++i) {
    const double pitch = 0.2 / holes;
    lines.push_back(-0.1 - 0.25 * pitch + pitch * (i / 2) + (i % 2 ? 0.42 * pitch : 0.0));
  }
  // Cells outside the rim's circle are left out; bars end inside the rim.
  const auto within = [&](size_t i, size_t j) {
    const double x = std::max(std::abs(lines[i]), std::abs(lines[i + 1])),
                 y = std::max(std::abs(lines[j]), std::abs(lines[j + 1]));
    return x * x + y * y < 0.1205 * 0.1205;
  };
  const auto filled = [&](size_t i, size_t j) {
    if (i % 2 == 1 && j % 2 == 1) return false;
    // A crossing stays with its bars, or two bars would meet at a corner only.
    const bool crossing = i % 2 == 0 && j % 2 == 0;
    const size_t last = lines.size() - 2;
    return within(i, j) || (crossing && ((i > 0 && within(i - 1, j)) || (i < last && within(i + 1, j)) ||
                                         (j > 0 && within(i, j - 1)) || (j < last && within(i, j + 1))));
  };
  place(scene, "sieve grid",
        transformed(panel(lines, lines, -0.0025, 0.0025, filled), where * moved({0, -0.02, 0}) * turned_x(-pi / 2)),
        color(0xE8B85A));
}

/// A tipper lorry along +X, its wheels on y = 0.
void add_lorry(Scene& scene, const glm::dmat4& where) {
  Mesh body = slab({-0.17, 0.045, -0.06}, {0.19, 0.075, 0.06}, 0.004);
  const Polygon cab = {{0.09, 0.07}, {0.185, 0.07}, {0.185, 0.115}, {0.15, 0.175}, {0.09, 0.175}};
  append(body, extrude(cab, -0.058, 0.058, 0.006));
  place(scene, "lorry", transformed(body, where), color(0x3F7CAC));
  // The bed: outside up, inside down.
  const auto ring = [](double x0, double x1, double half, double y) {
    return Ring{{x0, y, -half}, {x0, y, half}, {x1, y, half}, {x1, y, -half}};
  };
  const std::vector<Ring> bed = {ring(-0.16, 0.065, 0.055, 0.085), ring(-0.185, 0.078, 0.07, 0.16),
                                 ring(-0.177, 0.07, 0.062, 0.16), ring(-0.153, 0.058, 0.048, 0.092)};
  place(scene, "lorry bed", transformed(loft(bed), where * moved({-0.05, 0.035, 0}) * turned_z(-0.25)),
        color(0xE0A030));
  const Profile tyre = {{0.02, -0.016}, {0.038, -0.018}, {0.044, -0.012}, {0.045, 0},
                        {0.044, 0.012}, {0.038, 0.018},  {0.02, 0.016}};
  const uint32_t wheel = add_mesh(scene, "lorry wheel", lathe(tyre, 36));
  for (const double x : {-0.12, 0.13})
    for (const double z : {-0.062, 0.062})
      place(scene, "lorry wheel", wheel, color(0x3A3834), where * moved({x, 0.0445, z}) * turned_x(pi / 2));
}

Mesh star(double radius, double height) {
  Polygon polygon;
  for (int i = 0; i < 40; ++i) {
    const double a = 2 * pi * i / 40, r = radius * (0.64 + 0.36 * std::cos(5 * a));
    polygon.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  return transformed(extrude(polygon, 0, height, 0.006), turned_x(-pi / 2));
}

/// A fluted sand cake, as it comes out of a mould.
Mesh cake(double radius, double height) {
  std::vector<Ring> rings;
  const std::array<glm::dvec2, 5> profile = {
      glm::dvec2(1.06, -0.06), {1.0, 0.05}, {0.8, 0.9}, {0.74, 1.0}, {0.5, 1.02}};
  for (const glm::dvec2& p : profile) {
    Ring ring;
    for (int i = 0; i < 48; ++i) {
      const double a = 2 * pi * i / 48, r = radius * p.x * (1 + 0.06 * std::cos(8 * a));
      ring.emplace_back(r * std::cos(a), p.y * height, -r * std::sin(a));
    }
    rings.push_back(ring);
  }
  return loft(rings);
}

}  // namespace

BuiltinScene sandbox() {
  BuiltinScene entry;
  entry.name = "sandbox";
  entry.help = "bucket, spade, rake, sieve, ball and a castle of sand under a low sun, 28k triangles (RTW)";
  entry.make = [](const BuiltinValues&) {
    Scene scene;
    scene.name = "sandbox";
    place(scene, "sand", box({-1.45, -0.2, -1.45}, {1.45, 0, 1.45}), color(0xDCC08A));
    // A plank frame, mitred: a square ring.
    const double d = std::numbers::sqrt2;
    const Profile plank = {{1.52 * d, -0.21}, {1.52 * d, 0.11}, {1.51 * d, 0.12},
                           {1.41 * d, 0.12},  {1.4 * d, 0.11},  {1.4 * d, -0.21}};
    place(scene, "frame", transformed(lathe_ring(plank, 4), turned_y(pi / 4)), color(0x8F6A45));
    place(scene, "lawn", slab({-4, -0.5, -4}, {4, -0.12, 4}, 0.02), color(0x7F9A5B));

    add_castle(scene, moved({-0.45, 0, -0.4}) * turned_y(0.35));
    add_bucket(scene, moved({0.5, -0.001, -0.1}) * turned_y(0.5));
    add_spade(scene, moved({0.12, -0.06, 0.52}) * turned_y(0.8) * turned_x(0.22));
    // The rake lies on its back: head and shaft on the sand, tines up.
    add_rake(scene, moved({0.78, 0.0075, 0.62}) * turned_y(-0.9));
    add_ball(scene, {1.0, 0.158, -0.55}, 0.16);
    // The sieve is stuck into the sand, facing the sun.
    add_sieve(scene, along({-0.42, 0.1, 0.36}, {-0.85, 0.12, 0.5}));
    add_lorry(scene, moved({0.02, 0, -0.95}) * turned_y(-0.5));
    const uint32_t sand_cake = add_mesh(scene, "cake", cake(0.07, 0.08));
    const glm::dvec3 cakes[] = {{-0.12, 0, 0.85}, {-0.36, 0, 0.94}, {-0.62, 0, 0.9}};
    for (const glm::dvec3& p : cakes) place(scene, "cake", sand_cake, color(0xD3AF72), moved(p));
    place(scene, "star", transformed(star(0.1, 0.035), moved({-0.85, -0.002, 0.62}) * turned_y(0.3)), color(0x8A5A9A));

    add_camera(scene, "main", {0.75, 0.75, 2.1}, {0.05, 0.08, 0.05}, 44);
    add_camera(scene, "near", {1.32, 0.3, 1.35}, {0.35, 0.09, 0.12}, 40);
    add_sun(scene, 158, 17);
    return scene;
  };
  return entry;
}

}  // namespace shadewright::builtin
