#include "shadow/parameterization/perspective/warp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>
#include <numbers>

#include "shadewright/geometry/projection.h"
#include "shadow/parameterization/perspective/shadowable.h"

namespace shadewright::shadow {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The nearest a lamp looks, as a share of the farthest receiver's distance.
constexpr double near_share = 1e-4;
/// The least w in a map, as a share of the largest: beyond that floats lose the texel.
constexpr double least_w = 1e-4;
/// Room before the nearest and behind the farthest receiver, as a share of the depth range: clamped casters stay before
/// receivers.
constexpr double depth_margin = 0.01;
/// The share of the map's depths kept before the nearest receiver: a grazing receiver's bias must not reach what is
/// clamped there, or the casters nearer to the light are lost to it. A share of w, it is as far everywhere as the scale
/// there asks.
constexpr double depth_before = 0.5;

double along(const glm::dvec4& row, const glm::dvec3& point) {
  return glm::dot(row, glm::dvec4(point, 1.0));
}

glm::dvec4 distance_row(const LightFrame& light) {
  return -glm::row(light.view_from_world, 2);
}

/// Without a lamp itself: where it is in the hull it is a corner, whose image the other corners on the same rays have.
std::vector<glm::dvec3> before_light(std::vector<glm::dvec3> corners, const LightFrame& light) {
  if (!light.perspective) return corners;
  const glm::dvec4 distance = distance_row(light);
  double farthest = 0;
  for (const glm::dvec3& corner : corners) farthest = std::max(farthest, along(distance, corner));
  std::erase_if(corners, [&](const glm::dvec3& corner) { return along(distance, corner) < near_share * farthest; });
  return corners;
}

/// Across the light's axis, metres to each side.
std::vector<glm::dvec3> widened(const std::vector<glm::dvec3>& points, const LightFrame& light, double metres) {
  if (metres == 0) return points;
  const glm::dvec3 right(glm::row(light.view_from_world, 0)), up(glm::row(light.view_from_world, 1));
  std::vector<glm::dvec3> result;
  for (const glm::dvec3& point : points)
    for (const glm::dvec3& side : {right, -right, up, -up}) result.push_back(point + metres * side);
  return result;
}

/// A texel's size at a point in front of the map, across the light's axis: the sum of its sides, metres.
double texel_at(const glm::dmat4& rows, const LightFrame& light, const glm::dvec3& point, uint32_t resolution) {
  const double w = along(rows[3], point);
  const glm::dvec2 image = glm::dvec2(along(rows[0], point), along(rows[1], point)) / w;
  const auto move = [&](int axis) {
    const glm::dvec3 step(glm::row(light.view_from_world, axis));
    return (glm::dvec2(glm::dot(glm::dvec3(rows[0]), step), glm::dot(glm::dvec3(rows[1]), step)) -
            image * glm::dot(glm::dvec3(rows[3]), step)) /
           w;
  };
  const glm::dmat2 metres_from_image = glm::inverse(glm::dmat2(move(0), move(1)));
  const double size = 2.0 / resolution * (glm::length(metres_from_image[0]) + glm::length(metres_from_image[1]));
  return std::isfinite(size) && w > 0 ? size : 0;
}

/// What look-ups read around receivers within `corners`. Texels grow with the view depth in a map that follows the
/// camera, and do not in a uniform one: whichever bound is tighter.
WorldReach world_reach(const glm::dmat4& light_from_world, const LightFrame& light, const CameraMap& camera,
                       std::span<const glm::dvec3> corners, const FilterReach& reach, uint32_t resolution) {
  const glm::dmat4 rows = glm::transpose(light_from_world);
  double largest = 0, largest_per_depth = 0, farthest = 0;
  for (const glm::dvec3& corner : corners) {
    const double size = texel_at(rows, light, corner, resolution), depth = along(camera.w, corner);
    largest = std::max(largest, size);
    largest_per_depth = std::max(largest_per_depth, size / depth);
    farthest = std::max(farthest, depth);
  }
  const double texels = reach.texels + rounding_border_texels;
  if (largest_per_depth * farthest < 2 * largest) return {reach.metres, texels * largest_per_depth};
  return {reach.metres + texels * largest, 0};
}

struct Rectangle {
  glm::dvec2 low{infinity}, high{-infinity};
  void extend(const glm::dvec2& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  bool empty() const { return !(low.x <= high.x); }
  glm::dvec2 size() const { return high - low; }
  glm::dvec2 center() const { return 0.5 * (low + high); }
};

/// Bounds of the image of the receivers' boxes; everything where not all of them are in front.
Rectangle bounding_rectangle(const Projection& projection, const Receivers& receivers) {
  const glm::dmat4 transposed = glm::transpose(receivers.world_from_post);
  const glm::dvec4 x = transposed * projection.x, y = transposed * projection.y, w = transposed * projection.w;
  Rectangle bounds;
  for (const ReceiverBox& receiver : receivers.boxes) {
    const Box& box = receiver.post;
    const glm::dvec3 center = box.center(), half = 0.5 * box.size();
    const auto greatest = [&](const glm::dvec4& row) {
      return along(row, center) + glm::dot(glm::abs(glm::dvec3(row)), half);
    };
    if (!(greatest(-w) < 0)) return {glm::dvec2(-infinity), glm::dvec2(infinity)};
    // Few boxes reach beyond those before them, which takes no division to tell.
    if (!bounds.empty() && greatest(x - bounds.high.x * w) <= 0 && greatest(y - bounds.high.y * w) <= 0 &&
        greatest(bounds.low.x * w - x) <= 0 && greatest(bounds.low.y * w - y) <= 0)
      continue;
    for (const glm::dvec3& corner : box.corners())
      bounds.extend(glm::dvec2(along(x, corner), along(y, corner)) / along(w, corner));
  }
  return bounds;
}

}  // namespace

glm::dvec4 homogeneous_position(const Light& light) {
  return light.kind == LightKind::directional ? glm::dvec4(-light.direction, 0.0) : glm::dvec4(light.position, 1.0);
}

Projection perspective_projection(const glm::dvec4& light, const CameraMap& camera, const Receivers& receivers,
                                  double shift) {
  const glm::dmat4 post_from_world = camera.post_perspective(receivers.nearest, receivers.farthest, shift);
  Box bounds;
  for (const glm::dvec3& corner : receivers.corners) {
    const glm::dvec4 q = post_from_world * glm::dvec4(corner, 1.0);
    bounds.extend(glm::dvec3(q) / q.w);
  }
  const glm::dvec3 center = bounds.center();

  // The light there is l / l.w. A view from it along `axis` maps p to (u.(p - c), v.(p - c), axis.(p l.w - l)), u and v
  // across the axis through the centre c: that holds for l.w = 0 too, where light comes from a direction, and for l.w <
  // 0, an inverted light, whose axis leads away from it.
  const glm::dvec4 l = post_from_world * light;
  const glm::dvec3 axis = glm::normalize(center * l.w - glm::dvec3(l));
  glm::dvec3 u, v;
  perpendicular_axes(axis, u, v);
  const glm::dmat4 rows = glm::transpose(post_from_world);
  const auto combine = [&](const glm::dvec3& n) { return n.x * rows[0] + n.y * rows[1] + n.z * rows[2]; };
  return {combine(u) - glm::dot(u, center) * rows[3], combine(v) - glm::dot(v, center) * rows[3],
          l.w * combine(axis) - glm::dot(axis, glm::dvec3(l)) * rows[3]};
}

Projection light_space_projection(const LightFrame& light, const CameraMap& camera, const Receivers& receivers) {
  const Projection plain = uniform_projection(light);
  const auto image = [&](const glm::dvec3& p) {
    return glm::dvec2(along(plain.x, p), along(plain.y, p)) / along(plain.w, p);
  };
  // The view axis as the light sees it, between the nearest and the farthest receiver's depth.
  const glm::dmat4 world_from_post = glm::inverse(camera.post_perspective(receivers.nearest, receivers.farthest, 0.0));
  const auto on_axis = [&](double z) {
    const glm::dvec4 q = world_from_post * glm::dvec4(0, 0, z, 1);
    return glm::dvec3(q) / q.w;
  };
  const glm::dvec3 near_end = on_axis(-1), far_end = on_axis(1);
  if (!(along(plain.w, near_end) > 0) || !(along(plain.w, far_end) > 0)) return plain;
  const glm::dvec2 step = image(far_end) - image(near_end);
  const double steps = glm::length(step);
  const double length = receivers.farthest - receivers.nearest;
  const glm::dvec3 ray =
      light.perspective
          ? glm::normalize(0.5 * (near_end + far_end) - glm::dvec3(glm::inverse(light.view_from_world)[3]))
          : glm::dvec3(distance_row(light));
  const double sine = glm::length(glm::cross(ray, glm::normalize(camera.forward())));
  if (!(sine > 1e-3) || !(steps > 0)) return plain;

  const glm::dvec2 direction = step / steps;
  const double metres = length * sine / steps;  // of a unit of the light's plane
  double low = infinity, high = -infinity;
  for (const glm::dvec3& corner : receivers.corners) {
    if (!(along(plain.w, corner) > 0)) continue;
    const double d = glm::dot(direction, image(corner));
    low = std::min(low, d);
    high = std::max(high, d);
  }
  const double z_near = receivers.nearest, z_far = z_near + (high - low) * metres * sine;
  const double n = (z_near + std::sqrt(z_near * z_far)) / sine / metres;
  const glm::dvec2 across(-direction.y, direction.x);
  const double middle = glm::dot(across, image(near_end));
  return {across.x * plain.x + across.y * plain.y - middle * plain.w, plain.w,
          direction.x * plain.x + direction.y * plain.y + (n - low) * plain.w};
}

double least_shift(const Light& light, const LightFrame& frame, const CameraMap& camera, const Receivers& receivers,
                   const Box& scene) {
  Polytope h = clip(Polytope::from_box(scene), hull_planes(receivers.hull, homogeneous_position(light)));
  h = clip(h, window_planes(frame));
  double nearest = receivers.nearest;
  for (const glm::dvec3& corner : h.points()) nearest = std::min(nearest, along(camera.w, corner));
  return receivers.nearest - nearest;
}

std::optional<glm::dmat4> fit_projection(const Projection& projection, const LightFrame& light,
                                         const Receivers& receivers, const FitOptions& options) {
  const std::vector<glm::dvec3>& corners = receivers.corners;
  if (corners.empty()) return std::nullopt;
  const glm::dvec4 distance = distance_row(light);
  double nearest = infinity, farthest = -infinity;
  for (const glm::dvec3& corner : corners) {
    const double d = along(distance, corner);
    nearest = std::min(nearest, d);
    farthest = std::max(farthest, d);
  }
  double tip = -infinity;  // the part of the hull that is nearer holds no receiver
  if (light.perspective) {
    tip = std::max({near_share * farthest, 0.99 * receivers.light_distance, nearest});
    if (!(farthest > tip)) return std::nullopt;
  }

  std::vector<glm::dvec2> images;
  double w_low = infinity, w_high = 0;
  for (const glm::dvec3& corner : widened(before_light(corners, light), light, options.reach.metres)) {
    const double w = along(projection.w, corner);
    if (!(w > 0)) return std::nullopt;
    w_low = std::min(w_low, w);
    w_high = std::max(w_high, w);
    images.push_back(glm::dvec2(along(projection.x, corner), along(projection.y, corner)) / w);
  }
  if (!(w_low > least_w * w_high) || images.empty()) return std::nullopt;

  // Turned in units of its own bounds, so that the turn does not depend on the unit of either axis.
  Rectangle bounds;
  for (const glm::dvec2& p : images) bounds.extend(p);
  const double reach = std::max(
      {std::abs(bounds.low.x), std::abs(bounds.low.y), std::abs(bounds.high.x), std::abs(bounds.high.y), 1e-9});
  const glm::dvec2 center = bounds.center();
  const glm::dvec2 unit = glm::max(0.5 * bounds.size(), glm::dvec2(1e-6 * reach));
  for (glm::dvec2& p : images) p = (p - center) / unit;
  const glm::dvec2 axis = options.turn ? smallest_turn(images) : glm::dvec2(1, 0);
  const auto turned = [&](const glm::dvec2& p) { return glm::dvec2(glm::dot(axis, p), axis.x * p.y - axis.y * p.x); };
  Rectangle window;
  for (const glm::dvec2& p : images) window.extend(turned(p));
  const glm::dvec4 x = (projection.x - center.x * projection.w) / unit.x;
  const glm::dvec4 y = (projection.y - center.y * projection.w) / unit.y;
  const Projection in_units{axis.x * x + axis.y * y, axis.x * y - axis.y * x, projection.w};
  if (options.exact && options.reach.metres == 0) {
    const Rectangle of_boxes = bounding_rectangle(in_units, receivers);
    const glm::dvec2 low = glm::max(window.low, of_boxes.low), high = glm::min(window.high, of_boxes.high);
    if (low.x < high.x && low.y < high.y) window = {low, high};
  }

  const glm::dvec2 half = glm::max(0.5 * window.size(), glm::dvec2(1e-9)) *
                          widening(options.reach.texels + rounding_border_texels, options.resolution);
  const glm::dvec4 u = (in_units.x - window.center().x * projection.w) / half.x;
  const glm::dvec4 v = (in_units.y - window.center().y * projection.w) / half.y;

  // Depth is the light's distance over w, which does not change along a directional light's ray and is proportional to
  // the distance along a lamp's: it grows away from the light either way.
  const double range = std::max(farthest - nearest, 1e-6 * std::max({std::abs(farthest), std::abs(nearest), reach}));
  const double near = light.perspective ? 0.99 * tip : nearest - depth_margin * range;
  double scale = infinity;
  for (const glm::dvec3& corner : corners)
    if (const double d = along(distance, corner); d > near)
      scale = std::min(scale, along(projection.w, corner) / (d - near));
  const glm::dvec4 from_nearest = scale / (1 + depth_margin) * (distance - glm::dvec4(0, 0, 0, near));
  const glm::dvec4 depth = (1 - depth_before) * from_nearest + depth_before * projection.w;
  return glm::transpose(glm::dmat4(u, v, depth, projection.w) * (1.0 / w_high));
}

namespace {

/// What casts a shadow into a look-up around a receiver casts it onto the receiver if it is so much larger. Nothing is
/// known yet of a map in texels but how large those of the uniform one are.
std::vector<Box> reaching_casters(const LightFrame& frame, const Receivers& receivers, const WarpOptions& options) {
  std::vector<Box> casters(options.casters.begin(), options.casters.end());
  double reach = options.reach.metres;
  if (options.reach.texels > 0 && options.plain) {
    const glm::dmat4 rows = glm::transpose(*options.plain);
    double largest = 0;
    for (const ReceiverBox& box : receivers.boxes)
      largest = std::max(largest, texel_at(rows, frame, glm::dvec3(box.low), options.resolution));
    reach += options.reach.texels * widest_texel * largest;
  }
  for (Box& caster : casters) caster = {caster.min - reach, caster.max + reach};
  return casters;
}

/// The half-spaces of what a light's view reaches: its window, and the cone of a spot by planes that touch it.
std::vector<Plane> reach_planes(const Light& light, const LightFrame& frame) {
  std::vector<Plane> planes = window_planes(frame);
  if (light.kind != LightKind::spot) return planes;
  constexpr int sides = 8;
  const glm::dvec3 right(glm::row(frame.view_from_world, 0)), up(glm::row(frame.view_from_world, 1));
  const glm::dvec3 forward(distance_row(frame));
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / sides;
    const glm::dvec3 outwards = std::cos(angle) * right + std::sin(angle) * up;
    const glm::dvec3 normal = std::sin(light.outer_angle) * forward - std::cos(light.outer_angle) * outwards;
    planes.push_back({normal, -glm::dot(normal, light.position)});
  }
  return planes;
}

}  // namespace

Warp choose_warp(const Light& light, const LightFrame& frame, const CameraMap& camera, const Receivers& receivers,
                 const Box& scene, const WarpOptions& options) {
  Warp warp;
  warp.light_from_world = frame.view_from_world;
  if (receivers.boxes.empty()) return warp;
  const std::vector<Plane> reach = reach_planes(light, frame);
  Receivers reached = frame.perspective ? inside(receivers, reach) : receivers;
  if (!options.casters.empty()) {
    const std::vector<Box> reaching = options.soft ? reaching_casters(frame, reached, options) : std::vector<Box>{};
    keep_shadowable(reached, light, frame, options.soft ? reaching : options.casters);
  }
  bound(reached, reach);
  if (reached.hull.empty()) return warp;
  const bool face = light.kind == LightKind::point;
  FitOptions fit{options.resolution, face ? within_map(of_face(options.reach), options.resolution) : options.reach,
                 true, false};
  const LightPlane plane(frame, light, before_light(reached.corners, frame), reached.samples);
  const auto texel = [&](const std::optional<glm::dmat4>& matrix) {
    return matrix ? plane.mean_texel(*matrix) : infinity;
  };
  const Projection plain = uniform_projection(frame);
  const double plain_texel = texel(fit_projection(plain, frame, reached, fit));
  Projection best = plain;
  double best_texel = infinity;
  const auto consider = [&](const Projection& projection) {
    const double size = texel(fit_projection(projection, frame, reached, fit));
    if (!(size < best_texel)) return false;
    best_texel = size;
    best = projection;
    return true;
  };
  if (!plane.measurable()) {
    // No sample faces the light: any map will do.
  } else if (options.kind == WarpKind::best) {
    fit.turn = false;
    consider(plane.best_projection());
  } else if (options.kind == WarpKind::light_space) {
    consider(light_space_projection(frame, camera, reached));
  } else {
    const auto shifted = [&](double shift) {
      if (consider(perspective_projection(homogeneous_position(light), camera, reached, shift))) warp.shift = shift;
    };
    if (options.least_shift) {
      shifted(least_shift(light, frame, camera, reached, scene));
    } else {
      shifted(0);
      for (double shift = 0.25 * reached.nearest; shift < 8 * reached.farthest; shift *= 4) shifted(shift);
      for (const double factor : {0.5, 2.0, std::sqrt(0.5), std::sqrt(2.0)}) shifted(factor * warp.shift);
    }
  }

  fit.exact = true;
  std::optional<glm::dmat4> matrix;
  if (best_texel < (options.falls_back ? plain_texel : infinity)) matrix = fit_projection(best, frame, reached, fit);
  warp.fallback = !matrix;
  if (warp.fallback) {
    fit.turn = true;
    warp.shift = 0;
    matrix = fit_projection(plain, frame, reached, fit);
  } else {
    warp.gain = plain_texel / best_texel;
  }
  warp.drawn = matrix.has_value();
  if (!warp.drawn) return warp;
  warp.light_from_world = *matrix;
  // Never below the map that a user would have instead. Without surface points the estimate is too rough to tell it
  // from a warped one; two uniform ones differ the same way everywhere.
  const bool may_fall_back = warp.fallback || (options.seen && options.falls_back);
  if (options.plain && may_fall_back && plane.mean_texel(*options.plain) < texel(matrix)) {
    warp = {};
    warp.light_from_world = *options.plain;
    warp.drawn = warp.fallback = true;
  }
  warp.reach = world_reach(warp.light_from_world, frame, camera, before_light(reached.corners, frame), options.reach,
                           options.resolution);
  return warp;
}

}  // namespace shadewright::shadow
