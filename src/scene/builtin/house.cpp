#include "scene/builtin/house.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin/roof.h"
#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/shapes/mesh_edit.h"
#include "scene/builtin/shapes/panel.h"

namespace shadewright::builtin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double storey = 3.0, wall_thickness = 0.32, reveal = 0.17, sill_height = 0.95, head_height = 2.35;

/// One face of a house in its own frame: x along the wall, y up, the outside at z = 0.
struct Facade {
  double length = 9;
  int columns = 3, floors = 3;
  int door_column = -1;
  int balcony_column = -1;
  int balcony_bars = 9;
  double window_width = 1.1;
  double top = 9;
  double course_drop = 0;  ///< how much lower the bands between storeys lie, so that they lap at the corners

  double column_center(int column) const { return length * ((column + 0.5) / columns - 0.5); }
  double window_bottom(int floor) const { return storey * floor + sill_height; }
  double window_top(int floor) const { return storey * floor + head_height; }
  bool has_balcony(int column, int floor) const { return column == balcony_column && floor > 0; }
};

Mesh facade_wall(const Facade& f) {
  std::vector<double> xs = {-0.5 * f.length}, ys = {-0.4, 0.16};
  for (int c = 0; c < f.columns; ++c) {
    xs.push_back(f.column_center(c) - 0.5 * f.window_width);
    xs.push_back(f.column_center(c) + 0.5 * f.window_width);
  }
  xs.push_back(0.5 * f.length);
  for (int s = 0; s < f.floors; ++s) {
    ys.push_back(f.window_bottom(s));
    ys.push_back(f.window_top(s));
  }
  ys.push_back(f.top);
  return panel(xs, ys, -wall_thickness, 0, [&](size_t i, size_t j) {
    if (i % 2 == 0) return true;
    const bool is_door = static_cast<int>(i / 2) == f.door_column && (j == 1 || j == 2);
    const bool is_window = j >= 2 && j % 2 == 0;
    return !is_door && !is_window;
  });
}

/// Sills and, with more detail, lintels.
Mesh facade_stone(const Facade& f, int detail) {
  Mesh mesh;
  const double half = 0.5 * f.window_width;
  for (int s = 0; s < f.floors; ++s) {
    for (int c = 0; c < f.columns; ++c) {
      const double x = f.column_center(c), y = f.window_bottom(s);
      const bool is_door = s == 0 && c == f.door_column;
      if (!is_door && !f.has_balcony(c, s))
        append(mesh, box({x - half - 0.08, y - 0.1, -0.1}, {x + half + 0.08, y + 0.02, 0.09}));
      if (detail >= 2)
        append(mesh, slab({x - half - 0.12, f.window_top(s) - 0.02, -0.1},
                          {x + half + 0.12, f.window_top(s) + 0.18, 0.06}, 0.02));
      if (detail >= 3 && !is_door) {
        for (const double side : {-1.0, 1.0})
          append(mesh, box({x + side * (half + 0.03) - 0.05, y - 0.03, -0.1},
                           {x + side * (half + 0.03) + 0.05, f.window_top(s) + 0.01, 0.035}));
      }
    }
    if (detail >= 3 && s > 0)
      append(mesh, slab({-0.5 * f.length - 0.04, storey * s - 0.12 - f.course_drop, -0.1},
                        {0.5 * f.length + 0.04, storey * s + 0.1 - f.course_drop, 0.07}, 0.03));
  }
  return mesh;
}

/// Window bars in the reveal.
Mesh facade_bars(const Facade& f, int detail) {
  Mesh mesh;
  if (detail < 2) return mesh;
  const double half = 0.5 * f.window_width;
  for (int s = 0; s < f.floors; ++s) {
    for (int c = 0; c < f.columns; ++c) {
      if (s == 0 && c == f.door_column) continue;
      const double x = f.column_center(c), y0 = f.window_bottom(s), y1 = f.window_top(s);
      append(mesh, box({x - 0.03, y0 - 0.02, -0.2}, {x + 0.03, y1 + 0.02, -0.11}));
      for (int k = 1; k <= detail; ++k) {
        const double y = y0 + (y1 - y0) * k / (detail + 1);
        append(mesh, box({x - half - 0.02, y - 0.025, -0.19}, {x + half + 0.02, y + 0.025, -0.12}));
      }
    }
  }
  return mesh;
}

Mesh facade_shutters(const Facade& f, int detail) {
  Mesh mesh;
  const double half = 0.5 * f.window_width, width = 0.48 * f.window_width;
  for (int s = 0; s < f.floors; ++s) {
    for (int c = 0; c < f.columns; ++c) {
      if ((s == 0 && c == f.door_column) || f.has_balcony(c, s)) continue;
      for (const double side : {-1.0, 1.0}) {
        const double x = f.column_center(c) + side * (half + 0.06 + 0.5 * width);
        append(mesh, box({x - 0.5 * width, f.window_bottom(s) + 0.03, -0.02},
                         {x + 0.5 * width, f.window_top(s) - 0.01, 0.045}));
        if (detail < 3) continue;
        for (int k = 1; k < 8; ++k) {
          const double y = f.window_bottom(s) + (head_height - sill_height) * k / 8;
          append(mesh, box({x - 0.4 * width, y - 0.03, 0.02}, {x + 0.4 * width, y + 0.03, 0.065}));
        }
      }
    }
  }
  return mesh;
}

/// Slab and railing before each window of the balcony's column.
Mesh facade_balconies(const Facade& f) {
  Mesh mesh;
  if (f.balcony_column < 0) return mesh;
  const double x = f.column_center(f.balcony_column), half = 0.5 * f.window_width + 0.45, out = 1.05;
  for (int s = 1; s < f.floors; ++s) {
    const double y = storey * s + 0.12;
    append(mesh, box({x - half, y - 0.16, -0.1}, {x + half, y, out}));
    append(mesh, box({x - half + 0.02, y + 0.96, out - 0.09}, {x + half - 0.02, y + 1.02, out - 0.02}));
    for (int k = 0; k < f.balcony_bars; ++k) {
      const double bar = x - half + 0.06 + (2 * half - 0.12) * k / (f.balcony_bars - 1);
      append(mesh, box({bar - 0.018, y - 0.02, out - 0.075}, {bar + 0.018, y + 0.97, out - 0.04}));
    }
    for (const double side : {-1.0, 1.0}) {
      const double edge = x + side * (half - 0.06);
      append(mesh, box({edge - 0.03, y + 0.955, -0.05}, {edge + 0.03, y + 1.015, out - 0.05}));
      const int side_bars = (f.balcony_bars - 1) / 2;
      for (int k = 0; k < side_bars; ++k) {
        const double z = 0.1 + 0.88 * k / side_bars;
        append(mesh, box({edge - 0.015, y - 0.02, z}, {edge + 0.015, y + 0.97, z + 0.03}));
      }
    }
  }
  return mesh;
}

/// What a house collects per material while its four faces are added.
struct Materials {
  Mesh walls, stone, bars, shutters, metal;
};

void add_facade(Materials& m, const Facade& f, const glm::dmat4& where, int detail, bool shutters) {
  append(m.walls, facade_wall(f), where);
  append(m.stone, facade_stone(f, detail), where);
  append(m.bars, facade_bars(f, detail), where);
  append(m.metal, facade_balconies(f), where);
  if (shutters) append(m.shutters, facade_shutters(f, detail), where);
}

}  // namespace

Prop house(Scene& scene, const HouseShape& shape, Random& random) {
  const double w = shape.width, d = shape.depth, top = storey * shape.floors + (shape.roof == Roof::flat ? 0.75 : 0.1);
  Materials m;
  Facade front;
  front.length = w;
  front.columns = std::max(2, static_cast<int>(w / (shape.detail == 1 ? 3.1 : 2.6)));
  front.floors = shape.floors;
  front.top = top;
  front.balcony_bars = 3 + 2 * shape.detail;
  front.door_column = static_cast<int>(random.index(static_cast<uint32_t>(front.columns)));
  if (random.chance(0.55)) front.balcony_column = static_cast<int>(random.index(static_cast<uint32_t>(front.columns)));
  const bool shutters = shape.detail >= 2 && w / front.columns > 2.5 && random.chance(0.6);

  Facade back = front;
  back.door_column = -1;
  back.balcony_column = shape.detail >= 2 && random.chance(0.3) ? 0 : -1;
  if (shape.detail == 1) back.columns = std::max(1, front.columns - 1);
  // The side walls stand a little back from the corners and end lower, so that no two faces share a plane.
  Facade side = back;
  side.balcony_column = -1;
  side.length = d - wall_thickness;
  side.columns = shape.detail == 1 ? 1 : 2;
  side.top = top - 0.03;
  side.course_drop = 0.015;
  add_facade(m, front, moved({0, 0, 0.5 * d}), shape.detail, shutters);
  add_facade(m, back, moved({0, 0, -0.5 * d}) * turned_y(pi), shape.detail, false);
  for (const double s : {-1.0, 1.0})
    add_facade(m, side, moved({s * (0.5 * w - 0.025), 0, 0}) * turned_y(s * pi / 2), shape.detail, false);

  Prop prop;
  prop.name = "house";
  const double inner_w = 0.5 * w - 0.025 - reveal, inner_d = 0.5 * d - reveal;
  const glm::vec3 trim = color(0xE6E0D2);
  add_part(scene, prop, box({-inner_w, -0.35, -inner_d}, {inner_w, storey * shape.floors - 0.2, inner_d}),
           color(0x39424C));

  const double door_x = front.column_center(front.door_column);
  Mesh door = box({door_x - 0.53, -0.02, 0.5 * d - 0.3}, {door_x + 0.53, 2.0, 0.5 * d - 0.12});
  append(door, sphere(0.045, 6, 4), moved({door_x + 0.4, 1.1, 0.5 * d - 0.1}));
  add_part(scene, prop, std::move(door), color(random.chance(0.5) ? 0x6B3A2E : 0x2F5A54));
  append(m.stone, slab({door_x - 0.8, -0.3, 0.5 * d - 0.2}, {door_x + 0.8, 0.17, 0.5 * d + 0.42}, 0.02));
  append(m.stone, slab({door_x - 0.95, -0.3, 0.5 * d - 0.2}, {door_x + 0.95, 0.085, 0.5 * d + 0.75}, 0.02));

  add_part(scene, prop, std::move(m.walls), color(0xCDBfA6), true);
  add_part(scene, prop, std::move(m.stone), trim);
  add_part(scene, prop, std::move(m.bars), color(0xF0ECE2));
  add_part(scene, prop, std::move(m.metal), color(0x6E7074));
  add_part(scene, prop, std::move(m.shutters), color(random.chance(0.5) ? 0x4E6E58 : 0x7A4B3A));
  add_roof(scene, prop, shape, storey * shape.floors, random);
  return prop;
}

}  // namespace shadewright::builtin
