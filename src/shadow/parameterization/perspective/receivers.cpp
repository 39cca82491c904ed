#include "shadow/parameterization/perspective/receivers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>

#include "geometry/place_order.h"
#include "shadow/parameterization/uniform/fit.h"

namespace shadewright::shadow {

namespace {

/// What float depths are off by, relative, with room.
constexpr double depth_slack = 4e-6;
/// What pixel coordinates may be off by, normalized device coordinates.
constexpr double image_slack = 1e-5;

/// Normals of the bounding polytope in post-perspective space, each with its opposite. Ground and walls are slanted
/// planes there, hence the many that lean in depth.
constexpr std::array<std::array<int, 3>, 21> hull_normals{
    {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {1, 1, 0},  {1, -1, 0}, {1, 0, 1},  {1, 0, -1},
     {0, 1, 1},  {0, 1, -1}, {1, 1, 1},  {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}, {0, 1, 2},
     {0, 1, -2}, {0, 2, 1},  {0, 2, -1}, {1, 0, 2},  {1, 0, -2}, {2, 0, 1},  {2, 0, -1}}};

/// The polytope with the normals above that holds `boxes`, which are in [-1, 1]^3. All of it is before `farthest`.
Polytope bounding_polytope(std::span<const ReceiverBox> boxes, double farthest) {
  Box bounds;
  // Floats, which are off by less than a tenth of the slack there, in flat arrays of whole vectors, so that it
  // vectorizes. Along the axes far receivers need more.
  constexpr size_t axes = 3, lanes = 20, slanted = hull_normals.size() - axes;
  static_assert(slanted <= lanes);
  using PerNormal = std::array<float, lanes>;
  PerNormal nx{}, ny{}, nz{}, low, high;
  for (size_t i = 0; i < slanted; ++i) {
    nx[i] = static_cast<float>(hull_normals[i + axes][0]);
    ny[i] = static_cast<float>(hull_normals[i + axes][1]);
    nz[i] = static_cast<float>(hull_normals[i + axes][2]);
  }
  low.fill(std::numeric_limits<float>::infinity());
  high.fill(-std::numeric_limits<float>::infinity());
  for (const ReceiverBox& box : boxes) {
    bounds.extend(box.post);
    const glm::vec3 center(box.post.center()), reach(0.5 * box.post.size());
    for (size_t i = 0; i < lanes; ++i) {
      const float middle = nx[i] * center.x + ny[i] * center.y + nz[i] * center.z;
      const float around = std::abs(nx[i]) * reach.x + std::abs(ny[i]) * reach.y + std::abs(nz[i]) * reach.z;
      low[i] = middle - around < low[i] ? middle - around : low[i];
      high[i] = middle + around > high[i] ? middle + around : high[i];
    }
  }
  std::vector<Plane> planes;
  planes.reserve(2 * slanted);
  for (size_t i = 0; i < slanted; ++i) {
    const glm::dvec3 direction(nx[i], ny[i], nz[i]);
    const double length = glm::length(direction);
    planes.push_back({direction / length, image_slack - static_cast<double>(low[i]) / length});
    planes.push_back({-direction / length, image_slack + static_cast<double>(high[i]) / length});
  }
  // A polytope needs a volume.
  const glm::dvec3 half = glm::max(0.5 * bounds.size(), glm::dvec3(image_slack));
  Box box{bounds.center() - half, bounds.center() + half};
  box.max.z = std::min(box.max.z, farthest);
  return clip(Polytope::from_box(box), planes);
}

/// z of CameraMap::post_perspective at a view depth.
double post_depth(const Receivers& receivers, double depth) {
  const double near = receivers.nearest, far = receivers.farthest;
  return ((far + near) * depth - 2 * far * near) / ((far - near) * depth);
}

/// What is seen at view depths from `nearest` to `farthest`. In z the slack is one of depth: where the farthest is many
/// times the nearest, infinity is close to 1.
Box post_box(const Receivers& receivers, const glm::dvec2& low, const glm::dvec2& high, double nearest,
             double farthest) {
  return {{low - image_slack, post_depth(receivers, nearest * (1 - depth_slack))},
          {high + image_slack, post_depth(receivers, farthest * (1 + depth_slack))}};
}

}  // namespace

void bound(Receivers& receivers, std::span<const Plane> planes) {
  receivers.hull = {};
  if (!receivers.boxes.empty())
    receivers.hull = clip(transform(receivers.world_from_post,
                                    bounding_polytope(receivers.boxes, post_depth(receivers, 2 * receivers.farthest))),
                          planes);
  receivers.corners = receivers.hull.points();
  sort_distinct(receivers.corners);
}

CameraMap::CameraMap(const render::CameraView& camera)
    : x(glm::row(camera.clip_from_world, 0)),
      y(glm::row(camera.clip_from_world, 1)),
      w(glm::row(camera.clip_from_world, 3)) {
  const double scale = glm::length(glm::dvec3(w));
  x /= scale;
  y /= scale;
  w /= scale;
}

glm::dmat4 CameraMap::post_perspective(double near, double far, double shift) const {
  const double n = near + shift, f = far + shift;
  const glm::dvec4 depth = w + glm::dvec4(0, 0, 0, shift);
  const glm::dvec4 z = ((f + n) * depth - glm::dvec4(0, 0, 0, 2 * f * n)) / (f - n);
  return glm::transpose(glm::dmat4(x, y, z, depth));
}

TileGrid tile_grid(uint32_t width, uint32_t height) {
  const uint32_t side = (std::max((width + 63) / 64, (height + 35) / 36) + 1) / 2 * 2;
  return {side, (width + side - 1) / side, (height + side - 1) / side};
}

namespace {

/// Rays of all pixels: linear in the pixel.
struct PixelRays {
  explicit PixelRays(const render::CameraView& camera)
      : eye(camera.eye()),
        first(camera.ray({0, 0})),
        right(camera.ray({1, 0}) - first),
        down(camera.ray({0, 1}) - first) {}
  glm::dvec3 eye, first, right, down;
};

/// The surface point through `pixel` at `depth` with `normal`, unless it is seen edge-on.
void append_sample(std::vector<ReceiverSample>& samples, const PixelRays& rays, const glm::dvec2& pixel, double depth,
                   const glm::dvec3& normal) {
  const glm::dvec3 ray = rays.first + pixel.x * rays.right + pixel.y * rays.down;
  if (std::abs(glm::dot(normal, ray)) > 1e-3 * glm::length(ray)) samples.push_back({rays.eye + depth * ray, normal});
}

}  // namespace

Receivers visible_receivers(const render::CameraView& camera, std::span<const shared::VisibleTile> tiles,
                            const TileGrid& grid) {
  Receivers receivers;
  double near = std::numeric_limits<double>::infinity(), far = 0, light = near;
  size_t visible = 0;
  for (const shared::VisibleTile& tile : tiles) {
    if (tile.nearest > tile.farthest) continue;
    ++visible;
    near = std::min(near, static_cast<double>(tile.nearest));
    far = std::max(far, static_cast<double>(tile.farthest));
    light = std::min(light, static_cast<double>(tile.light_distance));
  }
  if (!(near <= far)) return receivers;
  receivers.nearest = near * (1 - depth_slack);
  receivers.farthest = std::max(far * (1 + depth_slack), near * (1 + 1e-4));
  receivers.light_distance = light;

  receivers.boxes.reserve(tiles.size());
  const PixelRays rays(camera);
  const uint32_t sample_stride = visible > 1200 ? 2 : 1;  // some hundred samples suffice
  const glm::dvec2 size(camera.width, camera.height);
  for (uint32_t row = 0; row < grid.rows; ++row)
    for (uint32_t column = 0; column < grid.columns; ++column) {
      const shared::VisibleTile& tile = tiles[row * grid.columns + column];
      if (tile.nearest > tile.farthest) continue;
      const glm::dvec2 first(column * grid.side, row * grid.side);
      const glm::dvec2 end = glm::min(first + static_cast<double>(grid.side), size);
      const glm::dvec2 low = 2.0 * (first + 0.5) / size - 1.0, high = 2.0 * (end - 0.5) / size - 1.0;
      receivers.boxes.push_back({post_box(receivers, low, high, tile.nearest, tile.farthest), tile.low, tile.high});
      if (tile.depth > 0 && row % sample_stride == 0 && column % sample_stride == 0)
        append_sample(receivers.samples, rays, glm::floor(0.5 * (first + end)) + 0.5, tile.depth,
                      glm::dvec3(tile.normal));
    }
  receivers.world_from_post =
      glm::inverse(CameraMap(camera).post_perspective(receivers.nearest, receivers.farthest, 0.0));
  return receivers;
}

Receivers bounded_receivers(const Frame& frame) {
  Receivers receivers;
  const std::vector<Plane> planes = frame.camera.planes();
  const std::vector<glm::dvec3> points = receiver_points(frame, planes);
  if (points.empty()) return receivers;
  const CameraMap camera(frame.camera);
  double near = std::numeric_limits<double>::infinity(), far = 0;
  for (const glm::dvec3& point : points) {
    const double depth = glm::dot(camera.w, glm::dvec4(point, 1));
    near = std::min(near, depth);
    far = std::max(far, depth);
  }
  receivers.nearest = near * (1 - depth_slack);
  receivers.farthest = std::max(far * (1 + depth_slack), near * (1 + 1e-4));
  const PixelRays rays(frame.camera);
  for (const glm::dvec3& point : points) {
    const glm::dvec4 p(point, 1);
    const double depth = glm::dot(camera.w, p);
    const glm::dvec2 image(glm::dot(camera.x, p) / depth, glm::dot(camera.y, p) / depth);
    receivers.boxes.push_back({post_box(receivers, image, image, depth, depth), glm::vec3(point), glm::vec3(point)});
    const glm::dvec3 to_light =
        frame.light.kind == LightKind::directional ? -frame.light.direction : frame.light.position - point;
    if (glm::length(to_light) > 0)
      append_sample(receivers.samples, rays, 0.5 * (image + 1.0) * glm::dvec2(frame.camera.width, frame.camera.height),
                    depth, glm::normalize(to_light));
  }
  receivers.world_from_post = glm::inverse(camera.post_perspective(receivers.nearest, receivers.farthest, 0.0));
  return receivers;
}

Receivers inside(const Receivers& receivers, std::span<const Plane> planes) {
  Receivers result;
  result.nearest = receivers.nearest;
  result.farthest = receivers.farthest;
  result.light_distance = receivers.light_distance;
  result.world_from_post = receivers.world_from_post;
  // The same half-spaces in post-perspective space, where receivers have a positive w.
  const glm::dmat4 transposed = glm::transpose(receivers.world_from_post);
  std::vector<glm::dvec4> rows;
  for (const Plane& plane : planes) rows.push_back(transposed * glm::dvec4(plane.normal, plane.offset));
  const auto reaches_inside = [&](const ReceiverBox& receiver) {
    const glm::dvec3 center = receiver.post.center(), half = 0.5 * receiver.post.size();
    return std::all_of(rows.begin(), rows.end(), [&](const glm::dvec4& row) {
      const glm::dvec3 normal(row);
      return glm::dot(normal, center) + glm::dot(glm::abs(normal), half) + row.w >= 0;
    });
  };
  std::copy_if(receivers.boxes.begin(), receivers.boxes.end(), std::back_inserter(result.boxes), reaches_inside);
  std::copy_if(receivers.samples.begin(), receivers.samples.end(), std::back_inserter(result.samples),
               [&](const ReceiverSample& sample) {
                 return std::all_of(planes.begin(), planes.end(),
                                    [&](const Plane& plane) { return plane.distance(sample.world) >= 0; });
               });
  return result;
}

}  // namespace shadewright::shadow
