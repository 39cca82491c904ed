#include "shadow/parameterization/uniform/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>
#include <numbers>

#include "shadewright/geometry/projection.h"

namespace shadewright::shadow {

namespace {

/// The nearest a perspective light looks, as a share of the farthest receiver's distance: float depth serves this range
/// well.
constexpr double near_share = 1e-4;
/// The least range of depths, as a share of the window's width, and of coordinates: receivers in one plane have none,
/// and what floats are off by must be small in it.
constexpr double least_range_of_width = 1e-2, least_range_of_coordinates = 1e-4;

glm::dvec3 view_coordinates(const LightFrame& light, const glm::dvec3& world) {
  return glm::dvec3(light.view_from_world * glm::dvec4(world, 1.0));
}

/// Half the size of a window: a receiver that is a point or a line in the light's view still needs an area.
glm::dvec2 least_half(const Box& window) {
  const glm::dvec2 center(window.center());
  const double least =
      1e-6 * std::max({window.size().x, window.size().y, std::abs(center.x), std::abs(center.y), 1e-9});
  return glm::max(glm::dvec2(0.5 * window.size()), least);
}

/// Appends to `points` the corners of the part of `box` inside all `planes`. `cutting` is room to work in.
void append_clipped(std::vector<glm::dvec3>& points, const Box& box, std::span<const Plane> planes,
                    std::vector<Plane>& cutting) {
  cutting.clear();
  const glm::dvec3 center = box.center(), half = 0.5 * box.size();
  for (const Plane& plane : planes)
    if (plane.distance(center) < glm::dot(glm::abs(plane.normal), half)) cutting.push_back(plane);
  if (cutting.empty()) {
    const auto corners = box.corners();
    points.insert(points.end(), corners.begin(), corners.end());
    return;
  }
  if (outside(box, cutting)) return;
  // Faces that meet in a corner have the same bits there.
  const auto first = static_cast<std::ptrdiff_t>(points.size());
  for (const Polytope::Face& face : clip(Polytope::from_box(box), cutting).faces)
    for (const glm::dvec3& corner : face.polygon)
      if (std::find(points.begin() + first, points.end(), corner) == points.end()) points.push_back(corner);
}

}  // namespace

std::vector<LightFrame> light_frames(const Light& light) {
  const auto frame = [&](const glm::dvec3& direction, double max_tangent) {
    const glm::dvec3 eye = light.kind == LightKind::directional ? glm::dvec3(0) : light.position;
    return LightFrame{look_along(eye, direction, {0, 1, 0}), light.kind != LightKind::directional, max_tangent};
  };
  switch (light.kind) {
    case LightKind::directional:
      return {frame(light.direction, 0)};
    case LightKind::spot:
      return {frame(light.direction, std::tan(light.outer_angle))};
    case LightKind::point:
      break;
  }
  std::vector<LightFrame> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      glm::dvec3 direction(0);
      direction[axis] = sign;
      faces.push_back(frame(direction, 1.0));
    }
  return faces;
}

std::vector<Plane> window_planes(const LightFrame& light) {
  if (!light.perspective) return {};
  const glm::dvec2 wide(light.max_tangent);
  std::vector<Plane> planes = frustum_planes(perspective_window(-wide, wide, 1, 2) * light.view_from_world);
  planes.resize(4);  // the sides alone
  return planes;
}

std::vector<glm::dvec3> receiver_points(const Frame& frame, std::span<const Plane> planes) {
  std::vector<glm::dvec3> points;
  std::vector<Plane> cutting;
  if (frame.scene)
    for (const Box& box : frame.scene->instance_bounds()) append_clipped(points, box, planes, cutting);
  if (!frame.draw_bounds.empty()) append_clipped(points, frame.draw_bounds, planes, cutting);
  return points;
}

Box receiver_bounds(const LightFrame& light, std::span<const glm::dvec3> points) {
  Box bounds;
  if (!light.perspective) {
    for (const glm::dvec3& point : points) bounds.extend(view_coordinates(light, point));
    return bounds;
  }
  // Cut by the window's planes, which meet in the light, all points are in front of it, but for the light itself.
  double farthest = 0;
  for (const glm::dvec3& point : points) farthest = std::max(farthest, -view_coordinates(light, point).z);
  for (const glm::dvec3& point : points) {
    const glm::dvec3 p = view_coordinates(light, point);
    const double distance = std::max(-p.z, near_share * farthest);
    bounds.extend({p.x / distance, p.y / distance, -distance});
  }
  return bounds;
}

glm::dvec2 smallest_turn(std::span<const glm::dvec2> points) {
  // Floats about the points' middle, in flat arrays, so that it vectorizes.
  constexpr size_t angles = 32;
  using PerAngle = std::array<float, angles>;
  PerAngle cosine, sine, low_x, high_x, low_y, high_y;
  for (size_t a = 0; a < angles; ++a) {
    const double angle = 0.5 * std::numbers::pi * static_cast<double>(a) / angles;
    cosine[a] = static_cast<float>(std::cos(angle));
    sine[a] = static_cast<float>(std::sin(angle));
  }
  low_x.fill(std::numeric_limits<float>::infinity());
  low_y = low_x;
  high_x.fill(-std::numeric_limits<float>::infinity());
  high_y = high_x;
  const auto take = [&](const glm::vec2& p) {
    for (size_t a = 0; a < angles; ++a) {
      const float x = p.x * cosine[a] + p.y * sine[a], y = p.y * cosine[a] - p.x * sine[a];
      low_x[a] = x < low_x[a] ? x : low_x[a];
      high_x[a] = x > high_x[a] ? x : high_x[a];
      low_y[a] = y < low_y[a] ? y : low_y[a];
      high_y[a] = y > high_y[a] ? y : high_y[a];
    }
  };
  // Those farthest in eight directions, counter-clockwise: most points lie within the octagon between them.
  std::array<glm::dvec2, 8> extremes;
  std::array<double, 8> farthest;
  farthest.fill(-std::numeric_limits<double>::infinity());
  for (const glm::dvec2& p : points) {
    const std::array<double, 4> along{p.x, p.x + p.y, p.y, p.y - p.x};
    for (size_t i = 0; i < 8; ++i)
      if (const double d = i < 4 ? along[i] : -along[i - 4]; d > farthest[i]) {
        farthest[i] = d;
        extremes[i] = p;
      }
  }
  const glm::dvec2 low(-farthest[4], -farthest[6]), high(farthest[0], farthest[2]);
  const glm::dvec2 center = 0.5 * (low + high);
  const double unit = std::max(high.x - low.x, high.y - low.y);
  const auto in_units = [&](const glm::dvec2& p) { return glm::vec2((p - center) / unit); };
  std::array<float, 8> normal_x, normal_y, offset;
  for (size_t i = 0; i < 8; ++i) {
    const glm::vec2 a = in_units(extremes[i]), side = in_units(extremes[(i + 1) % 8]) - a;
    normal_x[i] = -side.y;
    normal_y[i] = side.x;
    offset[i] = side.y * a.x - side.x * a.y;
    take(a);
  }
  for (const glm::dvec2& point : points) {
    const glm::vec2 p = in_units(point);
    int outside = 0;
    for (size_t i = 0; i < 8; ++i) outside |= normal_x[i] * p.x + normal_y[i] * p.y + offset[i] < 0 ? 1 : 0;
    if (outside != 0) take(p);
  }
  size_t best = 0;
  const auto area = [&](size_t a) { return (high_x[a] - low_x[a]) * (high_y[a] - low_y[a]); };
  for (size_t a = 1; a < angles; ++a)
    if (area(a) < (1 - 1e-5f) * area(best)) best = a;  // the first of those that floats do not tell apart
  const double angle = 0.5 * std::numbers::pi * static_cast<double>(best) / angles;
  return {std::cos(angle), std::sin(angle)};
}

LightFrame turn_to_fit(const LightFrame& light, std::span<const glm::dvec3> points) {
  if (light.perspective || points.empty()) return light;
  std::vector<glm::dvec2> images;
  images.reserve(points.size());
  for (const glm::dvec3& point : points) images.push_back(glm::dvec2(view_coordinates(light, point)));
  const glm::dvec2 axis = smallest_turn(images);
  glm::dmat4 turn(1.0);
  turn[0] = {axis.x, -axis.y, 0, 0};
  turn[1] = {axis.y, axis.x, 0, 0};
  LightFrame turned = light;
  turned.view_from_world = turn * light.view_from_world;
  return turned;
}

double widening(double border_texels, uint32_t resolution) {
  return resolution / std::max(resolution - 2 * border_texels, 1.0);
}

double seen_reach(const LightFrame& light, double distance, double metres) {
  return light.perspective ? std::min(metres / distance, light.max_tangent) : metres;
}

glm::dvec2 window_half(const LightFrame& light, const Box& receivers, uint32_t resolution, const FilterReach& reach) {
  return (least_half(receivers) + seen_reach(light, -receivers.max.z, reach.metres)) *
         widening(reach.texels + rounding_border_texels, resolution);
}

WorldReach reach_on_receivers(const LightFrame& light, const Box& receivers, uint32_t resolution,
                              const FilterReach& reach) {
  const glm::dvec2 half = window_half(light, receivers, resolution, reach);
  const double texel = 2 * std::max(half.x, half.y) / resolution * (light.perspective ? -receivers.min.z : 1);
  return {reach.metres + (reach.texels + rounding_border_texels) * texel, 0};
}

MapView fit_view(const LightFrame& light, const Box& receivers, uint32_t resolution, const FilterReach& reach) {
  if (receivers.empty()) return view_of_window(light, receivers, resolution);
  const glm::dvec2 center(receivers.center()), half = window_half(light, receivers, resolution, reach);
  return view_of_window(light, {{center - half, receivers.min.z}, {center + half, receivers.max.z}}, resolution);
}

MapView view_of_window(const LightFrame& light, const Box& window, uint32_t resolution) {
  MapView view;
  view.viewport = vk::Rect2D({0, 0}, {resolution, resolution});
  view.drawn = !window.empty();
  if (!view.drawn) {
    view.light_from_world = light.view_from_world;
    return view;
  }
  const glm::dvec2 center(window.center()), half = least_half(window);
  // Depth is clamped, not cut, before the nearest receiver. Half of the depths are kept for what is there: a grazing
  // receiver's bias must not reach it, or the casters nearer to the light are lost.
  if (light.perspective) {
    const double nearest = -window.max.z, farthest = -window.min.z;
    const double near = std::min(0.99 * nearest, nearest * farthest / (2 * farthest - nearest));
    view.light_from_world =
        perspective_window(center - half, center + half, near, 1.01 * farthest) * light.view_from_world;
  } else {
    const glm::dvec3 reach = glm::max(glm::abs(window.min), glm::abs(window.max));
    const double depth = std::max({window.size().z, least_range_of_width * std::max(half.x, half.y),
                                   least_range_of_coordinates * std::max({reach.x, reach.y, reach.z})});
    const Box box{{center - half, window.min.z - 0.01 * depth}, {center + half, window.max.z + depth}};
    view.light_from_world = orthographic(box) * light.view_from_world;
  }
  return view;
}

std::vector<Plane> caster_planes(const MapView& view, const render::CameraView& camera, const Light& light,
                                 bool receivers_in_camera, const WorldReach& reach) {
  std::vector<Plane> planes = frustum_planes(view.light_from_world);
  planes.erase(planes.begin() + 4);  // z >= 0: casters nearer to the light count
  if (!receivers_in_camera) return planes;
  const glm::dvec4 w = glm::row(camera.clip_from_world, 3);
  const double per_depth = reach.per_depth / glm::length(glm::dvec3(w));
  for (const Plane& of_camera : camera.planes()) {
    const glm::dvec3 normal = of_camera.normal + per_depth * glm::dvec3(w);
    const double length = glm::length(normal);
    const Plane plane{normal / length, (of_camera.offset + per_depth * w.w + reach.metres) / length};
    const double towards = light.kind == LightKind::directional ? -glm::dot(plane.normal, light.direction)
                                                                : plane.distance(light.position);
    if (towards >= 0) planes.push_back(plane);
  }
  return planes;
}

}  // namespace shadewright::shadow
