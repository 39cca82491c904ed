#include "shadow/parameterization/perspective/light_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>
#include <numbers>
#include <numeric>

#include "geometry/place_order.h"
#include "shadewright/geometry/projection.h"

namespace shadewright::shadow {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// So many samples tell one map from another, and a share of them a good map from a bad one.
constexpr size_t enough_samples = 640, phases = 8;
/// So many of the maps that the few samples tell to be good are compared by all.
constexpr size_t most_candidates = 4;
/// A texel that is so many times the median of a uniform map's counts half of what it would.
constexpr float large_texel = 16;

double along(const glm::dvec4& row, const glm::dvec3& point) {
  return glm::dot(row, glm::dvec4(point, 1.0));
}

/// The corners of the convex hull, by Andrew's monotone chain (1979).
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
  sort_distinct(points);
  std::vector<glm::dvec2> hull;
  for (int chain = 0; chain < 2; ++chain) {
    const size_t start = hull.size();
    for (const glm::dvec2& p : points) {
      const auto turns_right = [&] {
        const glm::dvec2 a = hull[hull.size() - 1] - hull[hull.size() - 2], b = p - hull[hull.size() - 2];
        return a.x * b.y - a.y * b.x <= 0;
      };
      while (hull.size() >= start + 2 && turns_right()) hull.pop_back();
      hull.push_back(p);
    }
    if (hull.size() > start + 1) hull.pop_back();  // the other chain begins with it
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace

Projection uniform_projection(const LightFrame& light) {
  const glm::dvec4 distance = -glm::row(light.view_from_world, 2);
  return {glm::row(light.view_from_world, 0), glm::row(light.view_from_world, 1),
          light.perspective ? distance : glm::dvec4(0, 0, 0, 1)};
}

LightPlane::LightPlane(const LightFrame& frame, const Light& light, std::span<const glm::dvec3> corners,
                       std::span<const ReceiverSample> samples)
    : plane_(uniform_projection(frame)) {
  glm::dvec2 low(infinity), high(-infinity);
  for (const glm::dvec3& corner : corners) {
    hull_.push_back(glm::dvec2(along(plane_.x, corner), along(plane_.y, corner)) / along(plane_.w, corner));
    low = glm::min(low, hull_.back());
    high = glm::max(high, hull_.back());
  }
  if (hull_.empty()) return;
  const glm::dvec2 center = 0.5 * (low + high);
  const double unit = std::max(
      {0.5 * (high.x - low.x), 0.5 * (high.y - low.y), 1e-9 * std::max(std::abs(center.x), std::abs(center.y)), 1e-12});
  plane_.x = (plane_.x - center.x * plane_.w) / unit;
  plane_.y = (plane_.y - center.y * plane_.w) / unit;
  for (glm::dvec2& p : hull_) p = (p - center) / unit;
  hull_ = convex_hull(std::move(hull_));

  const glm::dmat4 world_from_view = glm::inverse(frame.view_from_world);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec2 p = center + unit * glm::dvec2(i == 1, i == 2);
    points_[i] = world_from_view * glm::dvec4(p, frame.perspective ? -1 : 0, 1);
  }

  // Every eighth first, so that the first eighth is spread over the image as the whole is.
  const size_t used = std::min(samples.size(), enough_samples);
  const auto append = [&](const ReceiverSample& sample) {
    const glm::dvec3 to_light = light.kind == LightKind::directional ? -light.direction : light.position - sample.world;
    const double w = along(plane_.w, sample.world);
    if (!(glm::dot(sample.normal, to_light) > 0) || !(w > 0)) return;
    const glm::dvec2 p = glm::dvec2(along(plane_.x, sample.world), along(plane_.y, sample.world)) / w;
    const auto move = [&](const glm::dvec3& step) {
      return (glm::dvec2(glm::dot(glm::dvec3(plane_.x), step), glm::dot(glm::dvec3(plane_.y), step)) -
              p * glm::dot(glm::dvec3(plane_.w), step)) /
             w;
    };
    glm::dvec3 right, down;
    perpendicular_axes(sample.normal, right, down);
    const glm::dvec2 a = move(right), b = move(down);
    const double area = std::abs(a.x * b.y - a.y * b.x);
    if (!(area > 0)) return;
    x_.push_back(static_cast<float>(p.x));
    y_.push_back(static_cast<float>(p.y));
    right_x_.push_back(static_cast<float>(a.x));
    right_y_.push_back(static_cast<float>(a.y));
    down_x_.push_back(static_cast<float>(b.x));
    down_y_.push_back(static_cast<float>(b.y));
    inverse_area_.push_back(static_cast<float>(1 / area));
    edges_.push_back(sample.edges);
  };
  for (size_t phase = 0; phase < phases; ++phase) {
    for (size_t i = phase; i < used; i += phases) append(samples[i * samples.size() / used]);
    if (phase == 0) few_ = x_.size();
  }
  if (x_.empty()) return;
  if (few_ == 0) few_ = x_.size();
  few_edges_ = std::accumulate(edges_.begin(), edges_.begin() + static_cast<std::ptrdiff_t>(few_), 0.0f);
  all_edges_ = std::accumulate(edges_.begin(), edges_.end(), 0.0f);
  // In the plane the sides of a uniform map's texels are 1.
  plane_scale_ = static_cast<float>(std::numbers::sqrt2 / 2);
  std::vector<float> sizes;
  for (size_t i = 0; i < x_.size(); ++i)
    sizes.push_back(std::hypot(right_x_[i], right_y_[i], std::hypot(down_x_[i], down_y_[i])) * inverse_area_[i]);
  const auto median = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), median, sizes.end());
  surface_scale_ = 1 / *median;
}

double LightPlane::mean_texel(const glm::dmat4& light_from_world) const {
  const auto in_plane = [&](int i) {
    const glm::dvec3 values = glm::row(light_from_world, i) * points_;
    return glm::dvec3(values.y - values.x, values.z - values.x, values.x);
  };
  return mean_texel(Rows{in_plane(0), in_plane(1), in_plane(3)}, x_.size());
}

double LightPlane::mean_texel(const Rows& rows, size_t count) const {
  // With J the derivative of the map by the plane, K of the plane by the surface: the texel's sides on the surface are
  // the columns of (J K)^-1, whose Frobenius norm is that of J K over its determinant; in the plane the same without K.
  // The determinant of J is that of the rows / w^3.
  const double determinant = std::abs(glm::dot(rows.u, glm::cross(rows.v, rows.w)));
  const float in_plane = plane_scale_ / static_cast<float>(determinant),
              on_surface = surface_scale_ / static_cast<float>(determinant);
  const glm::vec3 u(rows.u), v(rows.v), w(rows.w);
  const float *x = x_.data(), *y = y_.data(), *right_x = right_x_.data(), *right_y = right_y_.data(),
              *down_x = down_x_.data(), *down_y = down_y_.data(), *inverse_area = inverse_area_.data(),
              *edges = edges_.data();
  std::array<float, enough_samples> sizes;
  for (size_t i = 0; i < count; ++i) {
    const float depth = w.x * x[i] + w.y * y[i] + w.z;
    const float inverse = 1 / depth;
    const float map_u = (u.x * x[i] + u.y * y[i] + u.z) * inverse, map_v = (v.x * x[i] + v.y * y[i] + v.z) * inverse;
    const float ux = u.x - map_u * w.x, uy = u.y - map_u * w.y, vx = v.x - map_v * w.x, vy = v.y - map_v * w.y;
    const float a = ux * right_x[i] + uy * right_y[i], b = ux * down_x[i] + uy * down_y[i],
                c = vx * right_x[i] + vy * right_y[i], d = vx * down_x[i] + vy * down_y[i];
    const float size = (std::sqrt(ux * ux + uy * uy + vx * vx + vy * vy) * in_plane +
                        std::sqrt(a * a + b * b + c * c + d * d) * inverse_area[i] * on_surface) *
                       depth * depth;
    sizes[i] = edges[i] * size / (1 + size * (1 / large_texel));
  }
  // Sums that do not wait for each other.
  constexpr size_t lanes = 8;
  std::array<float, lanes> sums{};
  std::fill(sizes.begin() + count, sizes.begin() + (count + lanes - 1) / lanes * lanes, 0.0f);
  for (size_t i = 0; i < count; i += lanes)
    for (size_t lane = 0; lane < lanes; ++lane) sums[lane] += sizes[i + lane];
  const float sum = std::accumulate(sums.begin(), sums.end(), 0.0f);
  return count == 0 ? 0 : static_cast<double>(sum / (count == few_ ? few_edges_ : all_edges_));
}

/// A projection of the plane: w grows along a direction, from its nearest to its farthest corner by a ratio; and the
/// map's axes, as angles in the image, whose own axes are across and along that direction, in units of its bounds.
struct LightPlane::Shape {
  double direction, log_ratio, axis_u, axis_v;
};

LightPlane::Rows LightPlane::rows(const Shape& shape) const {
  const glm::dvec2 direction(std::cos(shape.direction), std::sin(shape.direction));
  double low = infinity, high = -infinity;
  for (const glm::dvec2& p : hull_) {
    low = std::min(low, glm::dot(direction, p));
    high = std::max(high, glm::dot(direction, p));
  }
  const double growth = -std::expm1(-shape.log_ratio) / (high - low);  // w is 1 at the farthest corner
  Rows result;
  result.w = {growth * direction, 1 - growth * high};
  const auto value = [&](const glm::dvec3& row, const glm::dvec2& p) { return row.x * p.x + row.y * p.y + row.z; };
  inverse_w_.clear();
  for (const glm::dvec2& p : hull_) inverse_w_.push_back(1 / value(result.w, p));
  const auto fitted = [&](const glm::dvec3& row) {
    double from = infinity, to = -infinity;
    for (size_t i = 0; i < hull_.size(); ++i) {
      const double image = value(row, hull_[i]) * inverse_w_[i];
      from = std::min(from, image);
      to = std::max(to, image);
    }
    return (2.0 * row - (from + to) * result.w) / (to - from);
  };
  const glm::dvec3 across = fitted({-direction.y, direction.x, 0}), deep = fitted({direction, 0});
  result.u = fitted(std::cos(shape.axis_u) * across + std::sin(shape.axis_u) * deep);
  result.v = fitted(std::cos(shape.axis_v) * across + std::sin(shape.axis_v) * deep);
  return result;
}

Projection LightPlane::best_projection() const {
  constexpr double right_angle = 0.5 * std::numbers::pi;
  struct Candidate {
    double size;
    Shape shape;
  };
  std::vector<Candidate> candidates;
  const auto add = [&](const Shape& shape) { candidates.push_back({mean_texel(rows(shape), few_), shape}); };
  for (const double turn : {0.0, 0.25, 0.5, 0.75}) add({0, 0, turn * right_angle, (1 + turn) * right_angle});
  for (int sector = 0; sector < 8; ++sector)
    for (const double ratio : {1.6, 4.0, 12.0, 40.0})
      for (const double turn : {0.0, 0.5})
        add({0.5 * right_angle * sector, std::log(ratio), turn * right_angle, (1 + turn) * right_angle});
  std::partial_sort(candidates.begin(), candidates.begin() + most_candidates, candidates.end(),
                    [](const Candidate& a, const Candidate& b) { return a.size < b.size; });

  Shape best{0, 0, 0, right_angle};
  double smallest = infinity;
  const auto consider = [&](Shape shape) {
    // Beyond this ratio floats lose the texel; axes nearer to each other than this waste the map.
    shape.log_ratio = std::clamp(shape.log_ratio, 0.0, 8.0);
    if (std::abs(std::sin(shape.axis_v - shape.axis_u)) < 0.25) return false;
    const double size = mean_texel(rows(shape), x_.size());
    if (!(size < smallest)) return false;
    smallest = size;
    best = shape;
    return true;
  };
  for (size_t i = 0; i < most_candidates; ++i) consider(candidates[i].shape);
  // Each coordinate in turn, in ever smaller steps.
  for (double step = 1; step > 0.1; step *= 0.5)
    for (bool moved = true; moved;) {
      moved = false;
      for (int coordinate = 0; coordinate < 5; ++coordinate)
        for (const double sign : {step, -step}) {
          Shape shape = best;
          if (coordinate == 0) shape.direction += 0.25 * sign;
          if (coordinate == 1) shape.log_ratio += 0.4 * sign;
          if (coordinate == 2 || coordinate == 4) shape.axis_u += 0.2 * sign;
          if (coordinate == 3 || coordinate == 4) shape.axis_v += 0.2 * sign;
          const double before = smallest;
          if (!consider(shape)) continue;
          moved = moved || smallest < 0.995 * before;
          break;
        }
    }
  const Rows found = rows(best);
  const auto world = [&](const glm::dvec3& row) { return row.x * plane_.x + row.y * plane_.y + row.z * plane_.w; };
  return {world(found.u), world(found.v), world(found.w)};
}

}  // namespace shadewright::shadow
