#include "shadow/parameterization/cascaded/slices.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>

namespace shadewright::shadow {

std::vector<DepthRange> split(const DepthRange& range, uint32_t count, double lambda) {
  std::vector<DepthRange> slices;
  double from = range.nearest;
  for (uint32_t i = 1; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    const double logarithmic = range.nearest * std::pow(range.farthest / range.nearest, share);
    const double linear = range.nearest + (range.farthest - range.nearest) * share;
    const double to = i == count ? range.farthest : lambda * logarithmic + (1 - lambda) * linear;
    slices.push_back({from, to});
    from = to;
  }
  return slices;
}

double view_depth(const render::CameraView& camera, const glm::dvec3& world) {
  return glm::dot(glm::row(camera.clip_from_world, 3), glm::dvec4(world, 1.0));
}

DepthRange view_depths(const render::CameraView& camera, std::span<const glm::dvec3> points) {
  DepthRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const glm::dvec3& point : points) {
    const double depth = view_depth(camera, point);
    range.nearest = std::min(range.nearest, depth);
    range.farthest = std::max(range.farthest, depth);
  }
  return range;
}

std::vector<Plane> slice_planes(const render::CameraView& camera, const DepthRange& slice) {
  std::vector<Plane> planes = camera.planes();
  const glm::dvec4 w = glm::row(camera.clip_from_world, 3);
  const double length = glm::length(glm::dvec3(w));
  const glm::dvec3 axis = glm::dvec3(w) / length;
  if (slice.nearest > 0) planes.push_back({axis, (w.w - slice.nearest) / length});
  if (std::isfinite(slice.farthest)) planes.push_back({-axis, (slice.farthest - w.w) / length});
  return planes;
}

}  // namespace shadewright::shadow
