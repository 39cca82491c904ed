#include "light_fit.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_access.hpp>

#include "shadewright/error.h"
#include "shadewright/geometry/polytope.h"
#include "shadewright/geometry/projection.h"

namespace shadewright::voxel {

namespace {

/// Voxels of room around what is fitted, so that nothing lies on the outermost faces.
constexpr double kRoomVoxels = 2;

Box view_bounds(const Casters& casters, const glm::dmat4& view_from_world) {
  return tbb::parallel_reduce(
      tbb::blocked_range<size_t>(0, casters.triangles.size(), 16384), Box{},
      [&](const auto& range, Box box) {
        for (size_t t = range.begin(); t < range.end(); ++t)
          for (int i = 0; i < 3; ++i)
            box.extend(glm::dvec3(view_from_world * glm::dvec4(casters.positions[casters.triangles[t][i]], 1.0)));
        return box;
      },
      [](const Box& a, const Box& b) { return unite(a, b); });
}

/// The view-space bounds of what of the triangles lies inside all `planes` (view space).
Box clipped_bounds(const Casters& casters, const glm::dmat4& view_from_world, const std::vector<Plane>& planes) {
  return tbb::parallel_reduce(
      tbb::blocked_range<size_t>(0, casters.triangles.size(), 4096), Box{},
      [&](const auto& range, Box box) {
        std::vector<glm::dvec3> polygon, clipped;
        for (size_t t = range.begin(); t < range.end(); ++t) {
          polygon.clear();
          for (int i = 0; i < 3; ++i)
            polygon.push_back(
                glm::dvec3(view_from_world * glm::dvec4(casters.positions[casters.triangles[t][i]], 1.0)));
          for (const Plane& plane : planes) {
            clipped.clear();
            for (size_t i = 0; i < polygon.size(); ++i) {
              const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
              const double da = plane.distance(a), db = plane.distance(b);
              if (da >= 0) clipped.push_back(a);
              if ((da < 0) != (db < 0)) clipped.push_back(a + (b - a) * (da / (da - db)));
            }
            polygon.swap(clipped);
          }
          for (const glm::dvec3& point : polygon) box.extend(point);
        }
        return box;
      },
      [](const Box& a, const Box& b) { return unite(a, b); });
}

/// Voxel space from Vulkan's clip space.
glm::dmat4 voxel_from_clip(const LightGrid& grid) {
  const double half = 0.5 * grid.size();
  glm::dmat4 result(0.0);
  result[0][0] = half;
  result[3][0] = half;
  result[1][1] = half;
  result[3][1] = half;
  result[2][2] = grid.depth();
  result[3][3] = 1;
  return result;
}

/// The rotation of the view, with rows turned to texel x, texel y (down) and away from the light.
glm::dmat3 light_axes(const glm::dmat4& view_from_world) {
  glm::dmat3 axes(view_from_world);
  for (int column = 0; column < 3; ++column) {
    axes[column][1] = -axes[column][1];
    axes[column][2] = -axes[column][2];
  }
  return axes;
}

[[noreturn]] void refuse_empty() {
  throw InputError("bake", "no static triangle lies inside the light's window",
                   "widen --bounds or choose another light");
}

/// The view whose window around the casters (or bounds) is smallest: a turned window wastes up to half of its texels.
glm::dmat4 tightest_view(const Casters& casters, const Light& light, const BakeOptions& options) {
  constexpr int kTurns = 12;
  const glm::dmat4 upright = look_along(glm::dvec3(0.0), light.direction, glm::dvec3(0, 1, 0));
  std::array<glm::dmat4, kTurns> views;
  for (int i = 0; i < kTurns; ++i) {
    const double angle = i * glm::half_pi<double>() / kTurns;
    const glm::dvec3 up =
        std::cos(angle) * glm::row(glm::dmat3(upright), 1) + std::sin(angle) * glm::row(glm::dmat3(upright), 0);
    views[size_t(i)] = i == 0 ? upright : look_along(glm::dvec3(0.0), light.direction, up);
  }
  using Windows = std::array<Box, kTurns>;
  Windows windows;
  if (options.bounds) {
    for (size_t i = 0; i < kTurns; ++i) windows[i] = transform(views[i], *options.bounds);
  } else {
    windows = tbb::parallel_reduce(
        tbb::blocked_range<size_t>(0, casters.positions.size(), 16384), Windows{},
        [&](const auto& range, Windows found) {
          for (size_t v = range.begin(); v < range.end(); ++v)
            for (size_t i = 0; i < kTurns; ++i) found[i].extend(glm::dmat3(views[i]) * casters.positions[v]);
          return found;
        },
        [](Windows a, const Windows& b) {
          for (size_t i = 0; i < kTurns; ++i) a[i].extend(b[i]);
          return a;
        });
  }
  size_t best = 0;
  const auto area = [&](size_t i) { return windows[i].size().x * windows[i].size().y; };
  for (size_t i = 1; i < kTurns; ++i)
    if (area(i) < 0.98 * area(best)) best = i;  // the upright one where it matters little
  return views[best];
}

LightGrid fit_directional(const Casters& casters, const Light& light, const BakeOptions& options, LightGrid grid) {
  const glm::dmat4 view_from_world = tightest_view(casters, light, options);
  Box box = view_bounds(casters, view_from_world);
  if (options.bounds) {
    const Box wanted = transform(view_from_world, *options.bounds);
    Box window = intersect(box, Box{{wanted.min.x, wanted.min.y, -1e300}, {wanted.max.x, wanted.max.y, 1e300}});
    if (window.empty()) refuse_empty();
    const std::vector<Plane> sides{
        {{1, 0, 0}, -window.min.x}, {{-1, 0, 0}, window.max.x}, {{0, 1, 0}, -window.min.y}, {{0, -1, 0}, window.max.y}};
    const Box inside = clipped_bounds(casters, view_from_world, sides);
    if (inside.empty()) refuse_empty();
    box = {{window.min.x, window.min.y, std::max(wanted.min.z, inside.min.z)},
           {window.max.x, window.max.y, inside.max.z}};
    box.min.z = std::min(box.min.z, box.max.z);  // everything that casts lies beyond the bounds
  }
  const glm::dvec3 size = glm::max(box.size(), glm::dvec3(1e-6 * std::max(box.diagonal(), 1e-3)));
  const glm::dvec3 voxels(grid.size(), grid.size(), grid.depth());
  const glm::dvec3 padded = size / (1.0 - 2 * kRoomVoxels / voxels);
  box = {box.center() - 0.5 * padded, box.center() + 0.5 * padded};
  grid.light_from_world = light_axes(view_from_world);
  grid.voxel_from_world = voxel_from_clip(grid) * orthographic(box) * view_from_world;
  grid.texel_size = glm::dvec2(padded) / glm::dvec2(voxels);
  grid.voxel_depth = padded.z / voxels.z;
  return grid;
}

LightGrid fit_spot(const Casters& casters, const Light& light, const BakeOptions& options, LightGrid grid) {
  const glm::dmat4 view_from_world = look_along(light.position, light.direction, glm::dvec3(0, 1, 0));
  const double tangent = std::tan(light.outer_angle);
  // The frustum as half-spaces through the light; each plane is normalized.
  const double length = std::hypot(1.0, tangent);
  std::vector<Plane> planes{{{1 / length, 0, -tangent / length}, 0},
                            {{-1 / length, 0, -tangent / length}, 0},
                            {{0, 1 / length, -tangent / length}, 0},
                            {{0, -1 / length, -tangent / length}, 0}};
  Box box = clipped_bounds(casters, view_from_world, planes);
  if (options.bounds && !box.empty())
    box.min.z = std::max(box.min.z, transform(view_from_world, *options.bounds).min.z);
  if (box.empty() || !(box.min.z < 0)) refuse_empty();
  grid.far = -box.min.z * (1 + 1e-3);
  grid.near = std::clamp(-box.max.z * (1 - 1e-3), grid.far * 1e-4, grid.far * 0.5);
  grid.light_from_world = light_axes(view_from_world);
  grid.voxel_from_world = voxel_from_clip(grid) *
                          perspective_window(glm::dvec2(-tangent), glm::dvec2(tangent), grid.near, grid.far) *
                          view_from_world;
  grid.texel_size = glm::dvec2(2 * tangent / grid.size());
  return grid;
}

}  // namespace

LightGrid fit_light(const Casters& casters, const Light& light, const BakeOptions& options) {
  LightGrid grid;
  grid.kind = light.kind;
  grid.log2_size = uint32_t(std::bit_width(options.resolution) - 1);
  grid.log2_depth = uint32_t(std::bit_width(options.depth_voxels.value_or(options.resolution)) - 1);
  switch (light.kind) {
    case LightKind::directional:
      return fit_directional(casters, light, options, grid);
    case LightKind::spot:
      return fit_spot(casters, light, options, grid);
    case LightKind::point:
      break;
  }
  throw InputError("bake", "a point light has no single window", "use a directional or a spot light");
}

}  // namespace shadewright::voxel
