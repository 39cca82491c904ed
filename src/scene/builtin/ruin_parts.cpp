#include "scene/builtin/ruin_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/noise.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/sheet.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double cellar = 0.5;  // metres that everything reaches below the ground

uint32_t resolution(RuinPartSize size, double at_one) {
  return std::max(3u, static_cast<uint32_t>(std::lround(at_one * size.detail)));
}

/// Masonry is not flat: metres to push a face out at (u, v) metres along it.
double relief(double u, double v, uint32_t seed) {
  const double course = std::floor(v / 0.45), stone = std::floor(u / 0.9 + 0.5 * course);
  return 0.03 * noise(stone * 0.37 + 0.2, course * 0.53 + 0.1, seed) + 0.02 * noise(2.1 * u, 2.3 * v, seed + 7);
}

bool anything(uint32_t, uint32_t) {
  return true;
}

/// A closed loop's sheet: column `columns` repeats column 0 in place, as seams of sheets do.
template <typename Point>
Mesh round_sheet(uint32_t columns, uint32_t rows, const Point& point,
                 const std::function<bool(uint32_t, uint32_t)>& keep = anything) {
  return sheet(
      columns, rows, [&](uint32_t i, uint32_t j) { return point(2 * pi * (i % columns) / columns, double(j) / rows); },
      keep);
}

Mesh column_shaft(RuinPartSize size, double height, double broken, uint32_t seed) {
  const uint32_t around = resolution(size, 40), up = resolution(size, 14);
  const double top = height * (1 - broken);
  const auto point = [&](double angle, double t) {
    const double jag = broken > 0 ? 0.5 * noise(2.2 * std::cos(angle) + 9, 2.2 * std::sin(angle), seed) : 0.0;
    const double y = -cellar + t * (top + jag + cellar);
    const double swell = 0.42 - 0.07 * std::max(0.0, y) / height;
    const double radius = swell * (1 + 0.045 * std::cos(20 * angle)) + 0.012 * noise(3 * angle, 2 * y, seed + 1);
    return glm::dvec3(radius * std::cos(angle), y, -radius * std::sin(angle));
  };
  return round_sheet(around, up, point);
}

}  // namespace

Prop ruin_column(Scene& scene, RuinPartSize size, double broken, Random& random) {
  Prop prop;
  prop.name = "column";
  constexpr double height = 6;
  const uint32_t seed = random.next();
  Mesh stone = column_shaft(size, height, broken, seed);
  // The base's mouldings, and the capital of a whole column, are surfaces of revolution without caps.
  const uint32_t around = resolution(size, 28);
  const std::array<glm::dvec2, 6> base = {
      glm::dvec2(0.62, -cellar), {0.62, 0.14}, {0.56, 0.2}, {0.58, 0.28}, {0.5, 0.36}, {0.4, 0.4}};
  const std::array<glm::dvec2, 6> capital = {glm::dvec2(0.34, 5.85), {0.4, 5.95}, {0.4, 6.05}, {0.58, 6.3},
                                             {0.62, 6.32},           {0.62, 6.5}};
  const auto turned = [&](const auto& profile) {
    return sheet(
        around, static_cast<uint32_t>(profile.size() - 1),
        [&](uint32_t i, uint32_t j) {
          const double angle = 2 * pi * (i % around) / around;
          return glm::dvec3(profile[j].x * std::cos(angle), profile[j].y, -profile[j].x * std::sin(angle));
        },
        anything);
  };
  append(stone, turned(base));
  if (broken <= 0) append(stone, turned(capital));
  add_part(scene, prop, std::move(stone), color(0xD6C9AC), true);
  return prop;
}

Prop ruin_drum(Scene& scene, RuinPartSize size, Random& random) {
  Prop prop;
  prop.name = "drum";
  const uint32_t around = resolution(size, 40), seed = random.next();
  const double half = random.range(0.5, 1.3);
  const auto point = [&](double angle, double t) {
    const double radius = 0.4 * (1 + 0.045 * std::cos(20 * angle));
    return glm::dvec3(half * (2 * t - 1) + 0.1 * noise(2 * std::cos(angle), 2 * std::sin(angle), seed),
                      0.27 + radius * std::cos(angle), radius * std::sin(angle));
  };
  add_part(scene, prop, round_sheet(around, resolution(size, 6), point), color(0xD6C9AC), true);
  return prop;
}

Prop ruin_wall(Scene& scene, RuinPartSize size, double length, double height, bool single, Random& random) {
  Prop prop;
  prop.name = "broken wall";
  const uint32_t columns = resolution(size, 6 * length), rows = resolution(size, 6 * (height + cellar)),
                 seed = random.next();
  const double half = 0.5 * length, rim = random.range(0.45, 0.9);
  const auto at = [&](uint32_t i, uint32_t j) {
    return glm::dvec2(length * i / columns - half, -cellar + (height + cellar) * j / rows);
  };
  const auto keep = [&](uint32_t i, uint32_t j) {
    const glm::dvec2 p = at(i, j);
    const double ruin = height * (1 - 0.75 * std::pow(std::abs(p.x) / half, 2.5) * rim) +
                        1.3 * fractal_noise(0.45 * p.x, 0.3, 3, 0.55, seed) - 0.5;
    if (p.y > 0.6 && p.y > ruin) return false;
    // Windows every 3 m, at head height and above.
    const double u = std::abs(p.x - 3 * std::round(p.x / 3)), v = p.y - 3.4 * std::floor(p.y / 3.4);
    return !(u < 0.55 && v > 1.1 && v < 2.5 && p.y > 0);
  };
  Mesh stone = sheet(
      columns, rows,
      [&](uint32_t i, uint32_t j) {
        const glm::dvec2 p = at(i, j);
        return glm::dvec3(p.x, p.y, relief(p.x, p.y, seed) + (single ? 0.0 : 0.25));
      },
      keep);
  if (!single) {
    Mesh back = sheet(
        columns, rows,
        [&](uint32_t i, uint32_t j) {
          const glm::dvec2 p = at(i, j);
          return glm::dvec3(p.x, p.y, -0.25 - relief(p.x, p.y, seed + 3));
        },
        keep);
    for (glm::uvec3& t : back.triangles) std::swap(t.y, t.z);
    append(stone, back);
  }
  add_part(scene, prop, std::move(stone), color(0xC9B48F), true);
  return prop;
}

Prop ruin_arches(Scene& scene, RuinPartSize size, int spans, double height, Random& random) {
  Prop prop;
  prop.name = "arches";
  constexpr double span = 5, radius = 1.75, half_depth = 0.6;
  const double spring = height - radius - 0.9;  // where the arch leaves its piers
  const uint32_t seed = random.next(), steps = resolution(size, 20), rows = resolution(size, 10);
  Mesh stone;
  // Half of an arch's opening, from the foot of its pier to its crown.
  const auto opening = [&](double t) {
    const double straight = spring + cellar, bow = radius * pi / 2, way = t * (straight + bow);
    if (way < straight) return glm::dvec2(radius, -cellar + way);
    const double angle = (way - straight) / radius;
    return glm::dvec2(radius * std::cos(angle), spring + radius * std::sin(angle));
  };
  const auto outline = [&](double t) {
    const double straight = height + cellar, flat = 0.5 * span, way = t * (straight + flat);
    return way < straight ? glm::dvec2(0.5 * span, -cellar + way) : glm::dvec2(0.5 * span - (way - straight), height);
  };
  for (int k = 0; k < spans; ++k) {
    const double center = span * (k - 0.5 * (spans - 1));
    // The last arch has lost its crown.
    const bool worn = k == spans - 1 && spans > 1;
    for (const double side : {-1.0, 1.0}) {
      const auto kept = [&](uint32_t i, uint32_t) { return !worn || side < 0 || i < steps * 6 / 10; };
      for (const double face : {-1.0, 1.0}) {
        Mesh front = sheet(
            steps, rows,
            [&](uint32_t i, uint32_t j) {
              const double t = double(i) / steps;
              const glm::dvec2 p = glm::mix(opening(t), outline(t), double(j) / rows);
              return glm::dvec3(center + side * p.x, p.y, face * (half_depth + relief(center + p.x, p.y, seed)));
            },
            kept);
        // i runs up and j outwards: that is front-facing where side and face differ.
        if (side * face > 0)
          for (glm::uvec3& t : front.triangles) std::swap(t.y, t.z);
        append(stone, front);
      }
      Mesh soffit = sheet(
          steps, resolution(size, 4),
          [&](uint32_t i, uint32_t j) {
            const glm::dvec2 p = opening(double(i) / steps);
            return glm::dvec3(center + side * p.x, p.y, half_depth * (2.0 * j / resolution(size, 4) - 1));
          },
          kept);
      if (side > 0)
        for (glm::uvec3& t : soffit.triangles) std::swap(t.y, t.z);
      append(stone, soffit);
    }
  }
  add_part(scene, prop, std::move(stone), color(0xCDB994), true);
  return prop;
}

Prop ruin_tomb(Scene& scene, RuinPartSize size, Random& random) {
  Prop prop;
  prop.name = "tomb";
  const double half_x = random.range(1.5, 2.3), half_z = random.range(1.8, 2.8), height = random.range(2.3, 3);
  const uint32_t seed = random.next(), along = resolution(size, 22), rows = resolution(size, 18);
  Mesh stone;
  const double lost = random.range(0.2, 0.7);
  for (int k = 0; k < 4; ++k) {
    const double half = k % 2 == 0 ? half_x : half_z, out = k % 2 == 0 ? half_z : half_x;
    const auto at = [&](uint32_t i, uint32_t j) {
      return glm::dvec2(half * (2.0 * i / along - 1), -cellar + (height + cellar) * j / rows);
    };
    const Mesh wall = sheet(
        along, rows,
        [&](uint32_t i, uint32_t j) {
          const glm::dvec2 p = at(i, j);
          return glm::dvec3(p.x, p.y, out + (i == 0 || i == along ? 0.0 : relief(p.x + 10 * k, p.y, seed)));
        },
        [&](uint32_t i, uint32_t j) {
          const glm::dvec2 p = at(i, j);
          if (k == 0 && std::abs(p.x) < 0.55 && p.y < 1.9) return false;
          return k != 1 || p.y < height * (1 - lost * (0.5 + 0.5 * p.x / half)) + 0.5 * noise(1.7 * p.x, 0.4, seed);
        });
    append(stone, wall, turned_y(k * pi / 2));
  }
  const uint32_t bow = resolution(size, 20), lengthways = resolution(size, 16);
  append(stone, sheet(
                    bow, lengthways,
                    [&](uint32_t i, uint32_t j) {
                      const double angle = pi * i / bow;
                      return glm::dvec3(-half_x * 1.04 * std::cos(angle), height + 0.55 * half_x * std::sin(angle),
                                        half_z * 1.05 * (1 - 2.0 * j / lengthways));
                    },
                    [&](uint32_t i, uint32_t j) { return noise(0.21 * i + 0.5, 0.23 * j + 0.3, seed) < 0.28; }));
  add_part(scene, prop, std::move(stone), color(0xBFB096), true);
  return prop;
}

Prop ruin_dome(Scene& scene, RuinPartSize size, Random& random) {
  Prop prop;
  prop.name = "dome";
  constexpr double radius = 4.2, height = 5;
  const uint32_t seed = random.next(), around = resolution(size, 96), rows = resolution(size, 30),
                 up = resolution(size, 22);
  // A drum with eight doorways.
  const auto wall = [&](double r) {
    return round_sheet(
        around, rows,
        [&, r](double angle, double t) {
          const double y = -cellar + t * (height + cellar);
          return glm::dvec3(r * std::cos(angle), y, -r * std::sin(angle));
        },
        [&](uint32_t i, uint32_t j) {
          const double angle = 2 * pi * (i + 0.5) / around, y = -cellar + (j + 0.5) * (height + cellar) / rows;
          const double off = std::abs(angle - pi / 4 * std::round(angle / (pi / 4))) * radius;
          return off > 0.75 || y > 2.6 + std::sqrt(std::max(0.0, 0.75 * 0.75 - off * off));
        });
  };
  Mesh stone = wall(radius);
  append(stone, round_sheet(
                    around, up,
                    [&](double angle, double t) {
                      const double rise = t * 0.46 * pi, r = 1.03 * radius * std::cos(rise);
                      return glm::dvec3(r * std::cos(angle), height - 0.1 + radius * std::sin(rise),
                                        -r * std::sin(angle));
                    },
                    [&](uint32_t i, uint32_t j) {
                      const double angle = 2 * pi * i / around;
                      return noise(1.6 * std::cos(angle), 1.6 * std::sin(angle), 0.12 * j / size.detail, seed) < 0.12;
                    }));
  add_part(scene, prop, std::move(stone), color(0xD2C3A4), true);
  return prop;
}

Prop ruin_steps(Scene& scene, double half_x, double half_z, int steps) {
  Prop prop;
  prop.name = "steps";
  constexpr double rise = 0.18, tread = 0.34;
  std::vector<glm::dvec2> profile = {{0, -cellar}};  // (inwards, up)
  for (int k = 0; k < steps; ++k) {
    profile.emplace_back(tread * k, rise * (k + 1));
    profile.emplace_back(tread * (k + 1), rise * (k + 1));
  }
  Mesh stone;
  for (int k = 0; k < 4; ++k) {
    const double half = k % 2 == 0 ? half_x : half_z, out = k % 2 == 0 ? half_z : half_x;
    constexpr uint32_t along = 24;
    append(stone,
           sheet(
               along, static_cast<uint32_t>(profile.size() - 1),
               [&](uint32_t i, uint32_t j) {
                 const glm::dvec2 p = profile[j];
                 return glm::dvec3((half - p.x) * (2.0 * i / along - 1), p.y, out - p.x);
               },
               anything),
           turned_y(k * pi / 2));
  }
  // The floor, with slabs missing here and there.
  const double in = tread * steps;
  const uint32_t nx = static_cast<uint32_t>(2 * half_x), nz = static_cast<uint32_t>(2 * half_z);
  append(stone, sheet(
                    nx, nz,
                    [&](uint32_t i, uint32_t j) {
                      return glm::dvec3((half_x - in) * (2.0 * i / nx - 1), rise * steps,
                                        (half_z - in) * (1 - 2.0 * j / nz));
                    },
                    [&](uint32_t i, uint32_t j) {
                      return i == 0 || j == 0 || noise(0.45 * i + 0.2, 0.45 * j + 0.3, 77) < 0.35;
                    }));
  add_part(scene, prop, std::move(stone), color(0xC4B8A0), true);
  return prop;
}

Prop ruin_weeds(Scene& scene, uint32_t count, double radius, Random& random) {
  Prop prop;
  prop.name = "weeds";
  Mesh mesh;
  for (uint32_t k = 0; k < count; ++k) {
    const double r = radius * std::sqrt(random.unit()), a = random.angle(), turn = random.angle();
    const glm::dvec3 base(r * std::cos(a), -0.05, r * std::sin(a));
    const double height = random.range(0.2, 0.55), width = random.range(0.012, 0.03);
    const glm::dvec3 across(width * std::cos(turn), 0, width * std::sin(turn));
    const glm::dvec3 lean(-0.5 * height * std::sin(turn), height, 0.5 * height * std::cos(turn));
    const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::dvec3& p : {base - across, base + across, base + 0.55 * lean + 0.05 * height + across, base + lean})
      mesh.positions.emplace_back(glm::vec3(p));
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
  }
  add_part(scene, prop, std::move(mesh), color(0x8A9A4F), true);
  return prop;
}

Prop ruin_stone(Scene& scene, RuinPartSize size, Random& random) {
  Prop prop;
  prop.name = "stone";
  const uint32_t around = resolution(size, 14), up = resolution(size, 6), seed = random.next();
  const glm::dvec3 radii(random.range(0.25, 0.6), random.range(0.2, 0.4), random.range(0.2, 0.5));
  add_part(
      scene, prop,
      round_sheet(
          around, up,
          [&](double angle, double t) {
            const double rise = 0.49 * pi * t;
            const glm::dvec3 p(std::cos(rise) * std::cos(angle), std::sin(rise), -std::cos(rise) * std::sin(angle));
            // Rounded cubes rather than balls: hewn once.
            const double blunt =
                std::pow(std::pow(std::abs(p.x), 5) + std::pow(std::abs(p.y), 5) + std::pow(std::abs(p.z), 5), -0.2);
            return radii * p * blunt * (1 + 0.12 * noise(2 * p.x, 2 * p.y, 2 * p.z, seed)) - glm::dvec3(0, 0.05, 0);
          }),
      color(0xB9AC94), true);
  return prop;
}

}  // namespace shadewright::builtin
