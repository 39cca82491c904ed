// Reprojection of surface points between frames, and what changed there. Sums of whole numbers, so that figures do not
// depend on the number of threads.
#include "shadewright/compare/flicker.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "raytrace/pixel_rays.h"
#include "shadewright/error.h"

namespace shadewright::compare {
namespace {

constexpr uint32_t none = ~0u;
constexpr PixelsAround nowhere = {none, none, none, none};

/// A point this near to a column (row) of pixel centres, in pixels, is on it: a still camera finds its own pixels again
/// whatever the rounding.
constexpr double on_center = 1.0 / 16;
/// How far a point may lie off the other pixel's tangent plane, as a share of its distance from that pixel's point.
constexpr double curvature = 0.1;
/// Cosine between the normals of two points of one surface next to each other: less is another face.
constexpr double same_face = 0.8;

void require_images(const SeenFrame& frame) {
  const size_t pixels = size_t{frame.grid.width} * frame.grid.height;
  for (const size_t size : {frame.points.size(), frame.facing.size(), frame.instances.size()})
    if (size != pixels)
      throw InputError("flicker", fmt::format("an image has {} pixels and its grid {}", size, pixels));
}

/// Image position of a world point; none behind the camera.
class Projection {
 public:
  explicit Projection(const PixelGrid& grid) : rays_(grid) {
    to_image_ = glm::inverse(glm::dmat3(rays_.step_x, rays_.step_y, rays_.corner));
  }
  std::optional<glm::dvec2> operator()(const glm::dvec3& world) const {
    const glm::dvec3 p = to_image_ * (world - rays_.eye);
    if (p.z <= 0) return std::nullopt;
    return glm::dvec2(p) / p.z;
  }

 private:
  PixelRays rays_;
  glm::dmat3 to_image_;  ///< (x, y, 1) * view depth from a vector off the eye
};

/// How each instance moved between two times.
std::vector<glm::dmat4> motions(const Scene& scene, double from, double to) {
  std::vector<glm::dmat4> moved(scene.instances.size(), glm::dmat4(1.0));
  for (size_t i = 0; i < moved.size(); ++i)
    if (scene.instances[i].motion && from != to)
      moved[i] =
          transform_at(scene, scene.instances[i], to) * glm::inverse(transform_at(scene, scene.instances[i], from));
  return moved;
}

/// The two pixels whose centres lie around image coordinate `at`, twice the same if it lies on one's; as signed
/// numbers, since they may lie outside.
std::array<int64_t, 2> centers_around(double at) {
  const double below = std::floor(at - 0.5);
  const double share = at - 0.5 - below;
  const auto low = static_cast<int64_t>(below);
  if (share < on_center) return {low, low};
  if (share > 1 - on_center) return {low + 1, low + 1};
  return {low, low + 1};
}

/// Finds one point of a frame in the other.
class Finder {
 public:
  Finder(const Scene& scene, const SeenFrame& from, const SeenFrame& to)
      : from_(from), to_(to), moved_(motions(scene, from.time, to.time)), project_(to.grid) {}

  PixelsAround operator()(size_t i) const {
    const uint32_t instance = from_.instances[i];
    if (from_.facing[i] == 0 || instance == none) return nowhere;
    const glm::dvec3 point(moved_[instance] * glm::dvec4(glm::dvec3(from_.points[i].position), 1.0));
    const glm::dvec3 normal = glm::dmat3(moved_[instance]) * glm::dvec3(from_.points[i].normal);
    const std::optional<glm::dvec2> at = project_(point);
    if (!at || !(std::abs(at->x) < 1e6 && std::abs(at->y) < 1e6)) return nowhere;
    const double error =
        static_cast<double>(position_error(from_.points[i].position, glm::vec3(from_.grid.camera.eye)) +
                            position_error(glm::vec3(point), glm::vec3(to_.grid.camera.eye)));
    const auto columns = centers_around(at->x), rows = centers_around(at->y);
    PixelsAround around = nowhere;
    for (size_t k = 0; k < around.size(); ++k) {
      const int64_t x = columns[k % 2], y = rows[k / 2];
      if (x < 0 || y < 0 || x >= to_.grid.width || y >= to_.grid.height) return nowhere;
      const size_t j = static_cast<size_t>(y) * to_.grid.width + static_cast<size_t>(x);
      if (to_.instances[j] != instance || !same_surface(point, normal, error, j)) return nowhere;
      around[k] = static_cast<uint32_t>(j);
    }
    return around;
  }

 private:
  bool same_surface(const glm::dvec3& point, const glm::dvec3& normal, double error, size_t j) const {
    const glm::dvec3 there_normal(to_.points[j].normal), off = point - glm::dvec3(to_.points[j].position);
    return to_.facing[j] != 0 && glm::dot(normal, there_normal) > same_face &&
           std::abs(glm::dot(off, there_normal)) <= error + curvature * glm::length(off);
  }

  const SeenFrame& from_;
  const SeenFrame& to_;
  std::vector<glm::dmat4> moved_;
  Projection project_;
};

}  // namespace

std::vector<uint32_t> instances_seen(const Tracer& tracer, const PixelGrid& grid, double near,
                                     std::span<const SurfacePoint> points) {
  const std::vector<PrimaryHit> hits = tracer.primary(grid, near);
  const glm::vec3 eye(grid.camera.eye);
  const PixelRays rays(grid);
  std::vector<uint32_t> instances(points.size(), none);
  for (size_t i = 0; i < points.size(); ++i) {
    if (!points[i].valid() || hits[i].distance == 0) continue;
    const double deeper = glm::dot(glm::dvec3(points[i].position) - rays.eye, rays.forward) - double{hits[i].distance};
    // Both lie on the pixel's ray.
    const glm::dvec3 ray = rays(static_cast<double>(i % grid.width) + 0.5, static_cast<double>(i / grid.width) + 0.5);
    const double off_plane = std::abs(deeper * glm::dot(glm::dvec3(hits[i].normal), ray));
    if (off_plane <= 2.0 * static_cast<double>(position_error(points[i].position, eye)))
      instances[i] = hits[i].instance;
  }
  return instances;
}

std::vector<PixelsAround> reproject(const Scene& scene, const SeenFrame& from, const SeenFrame& to) {
  require_images(from);
  require_images(to);
  const Finder find(scene, from, to);
  std::vector<PixelsAround> around(from.points.size());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, around.size(), 4096), [&](const auto& range) {
    for (size_t i = range.begin(); i != range.end(); ++i) around[i] = find(i);
  });
  return around;
}

FlickerCount& FlickerCount::operator+=(const FlickerCount& other) {
  points += other.points;
  changed += other.changed;
  return *this;
}

FlickerCount count_flicker(std::span<const PixelsAround> around, std::span<const uint8_t> wrong_from,
                           std::span<const uint8_t> wrong_to) {
  return tbb::parallel_reduce(
      tbb::blocked_range<size_t>(0, around.size(), 16384), FlickerCount{},
      [&](const tbb::blocked_range<size_t>& range, FlickerCount count) {
        for (size_t i = range.begin(); i != range.end(); ++i) {
          if (around[i][0] == none) continue;
          ++count.points;
          count.changed += std::ranges::all_of(around[i], [&](uint32_t j) { return wrong_to[j] != wrong_from[i]; });
        }
        return count;
      },
      [](FlickerCount a, const FlickerCount& b) { return a += b; });
}

}  // namespace shadewright::compare
