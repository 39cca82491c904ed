#include "batch.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

#include "lookup.h"

namespace shadewright::voxel {

namespace {

float filtered_at(const DagView& dag, const LightGrid& light, const glm::dvec3& at, uint32_t taps) {
  const double size = light.size(), reach = taps / 2;
  const bool near = at.x >= -reach && at.x < size + reach && at.y >= -reach && at.y < size + reach && at.z >= 0;
  if (!near) return 1.0f;  // also for what is not a number
  const uint32_t z = uint32_t(std::min(at.z, double(light.depth() - 1)));
  const int32_t x = int32_t(std::floor(at.x)), y = int32_t(std::floor(at.y)), last = int32_t(light.size()) - 1;
  const int32_t x0 = std::max(x - int32_t(taps / 2), 0), x1 = std::min(x + int32_t(taps / 2), last);
  const int32_t y0 = std::max(y - int32_t(taps / 2), 0), y1 = std::min(y + int32_t(taps / 2), last);
  uint32_t inside = 0, lit = 0;
  for (int32_t leaf_y = y0 >> 3; leaf_y <= y1 >> 3; ++leaf_y)
    for (int32_t leaf_x = x0 >> 3; leaf_x <= x1 >> 3; ++leaf_x) {
      const uint64_t mask = filter_mask(leaf_x, leaf_y, x0, x1, y0, y1);
      inside += uint32_t(std::popcount(mask));
      lit += uint32_t(std::popcount(mask & find_leaf(dag, uint32_t(leaf_x) * 8, uint32_t(leaf_y) * 8, z)));
    }
  return float(lit + taps * taps - inside) / float(taps * taps);
}

}  // namespace

void look_up(const DagView& dag, const LightGrid& light, std::span<const SurfacePoint> points, uint32_t taps,
             std::span<float> result) {
  tbb::parallel_for(tbb::blocked_range<size_t>(0, points.size(), 4096), [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); ++i)
      result[i] = filtered_at(
          dag, light, light.receiver_voxel(glm::dvec3(points[i].position), glm::dvec3(points[i].normal), taps), taps);
  });
}

}  // namespace shadewright::voxel
