#include "shadewright/voxel/shadow.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "batch.h"
#include "lookup.h"
#include "shadewright/error.h"

namespace shadewright::voxel {

VoxelShadow::VoxelShadow(const ShadowProperties& properties, std::vector<DagView> dags,
                         std::vector<std::vector<uint64_t>> level_starts, std::shared_ptr<const void> owner)
    : properties_(properties),
      dags_(std::move(dags)),
      level_starts_(std::move(level_starts)),
      owner_(std::move(owner)) {}

VoxelShadow VoxelShadow::moved(const glm::dvec3& by) const {
  VoxelShadow result = *this;
  result.properties_.light = light().moved(by);
  return result;
}

uint64_t VoxelShadow::dag_bytes() const {
  uint64_t bytes = 0;
  for (const DagView& dag : dags_) bytes += dag.nodes.size_bytes() + dag.leaves.size_bytes();
  return bytes;
}

uint64_t VoxelShadow::grid_bytes() const {
  uint64_t bytes = 0;
  for (const DagView& dag : dags_) bytes += dag.grid.size_bytes();
  return bytes;
}

void VoxelShadow::check_taps(uint32_t taps) const {
  if (taps % 2 == 0)
    throw InputError(fmt::format("filter {}", taps), "the side of a filter must be odd", "use 1, 3, .. 17");
  if (taps > properties_.max_filter)
    throw InputError(fmt::format("filter {}", taps),
                     fmt::format("the shadow was baked for filters up to {}, larger ones could read undefined voxels",
                                 properties_.max_filter),
                     "bake with a larger --max-filter");
}

bool VoxelShadow::visible(const glm::ivec3& voxel) const {
  const int32_t size = int32_t(light().size());
  if (voxel.x < 0 || voxel.y < 0 || voxel.z < 0 || voxel.x >= size || voxel.y >= size) return true;
  return find_voxel(dags_[0], uint32_t(voxel.x), uint32_t(voxel.y), std::min(uint32_t(voxel.z), light().depth() - 1));
}

float VoxelShadow::filtered(const glm::ivec3& voxel, uint32_t taps) const {
  check_taps(taps);
  const int32_t reach = int32_t(taps / 2), size = int32_t(light().size());
  // Saturated, so that a voxel at the end of the integers cannot wrap around.
  const glm::ivec3 middle = glm::clamp(voxel, glm::ivec3(-32), glm::ivec3(size + 32));
  if (middle.z < 0) return 1.0f;
  const uint32_t z = std::min(uint32_t(middle.z), light().depth() - 1);
  uint32_t inside = 0, lit = 0;
  const int32_t x0 = std::max(middle.x - reach, 0), x1 = std::min(middle.x + reach, size - 1);
  const int32_t y0 = std::max(middle.y - reach, 0), y1 = std::min(middle.y + reach, size - 1);
  for (int32_t y = y0 >> 3; y <= y1 >> 3; ++y)
    for (int32_t x = x0 >> 3; x <= x1 >> 3; ++x) {
      if (x0 > x1 || y0 > y1) continue;
      const uint64_t mask = filter_mask(x, y, x0, x1, y0, y1);
      inside += uint32_t(std::popcount(mask));
      lit += uint32_t(std::popcount(mask & find_leaf(dags_[0], uint32_t(x) * 8, uint32_t(y) * 8, z)));
    }
  return float(lit + taps * taps - inside) / float(taps * taps);
}

void VoxelShadow::visibility(std::span<const SurfacePoint> points, uint32_t taps, std::span<float> result) const {
  check_taps(taps);
  if (points.size() != result.size())
    throw InputError("visibility", fmt::format("{} points but room for {} results", points.size(), result.size()));
  look_up(dags_[0], light(), points, taps, result);
}

}  // namespace shadewright::voxel
