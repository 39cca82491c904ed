#include "direct.h"

#include <algorithm>
#include <cmath>

namespace shadewright::voxel {

int32_t filter_margin(const LightGrid& grid, uint32_t max_filter) {
  const double texel = std::max(grid.texel_size.x, grid.texel_size.y);
  // Spot: voxels a texel's side is long in z; it is largest at the near plane.
  const double per_texel = grid.kind == LightKind::directional
                               ? texel / grid.voxel_depth
                               : texel * grid.far / (grid.far - grid.near) * double(grid.depth());
  return int32_t(std::min(std::ceil(0.36 * max_filter * per_texel + 1), 1e9));
}

TexelRange range_of_crossings(std::span<const std::pair<int32_t, Crossing>> crossings, bool static_receivers) {
  TexelRange range;
  int32_t first_open = kNoHit, first_closed = kNoHit, second = kNoHit;
  for (const auto& [height, crossing] : crossings) {
    second = std::min(second, std::max(range.first, height));
    range.first = std::min(range.first, height);
    int32_t& first = crossing == Crossing::open ? first_open : first_closed;
    first = std::min(first, height);
  }
  const auto leave_bodies = [&](int32_t from) {
    while (from != kNoHit) {
      int count = 0;
      int32_t further = kNoHit;
      for (const auto& [height, crossing] : crossings) {
        if (crossing == Crossing::open) continue;
        if (height <= from) count += int(crossing);
        if (height > from) further = std::min(further, height);
      }
      if (count == 0) break;
      from = further;
    }
    return from;
  };
  range.limit = first_closed < first_open ? leave_bodies(first_closed) : range.first;
  if (static_receivers) range.limit = std::max(range.limit, second);
  int32_t next_open = kNoHit, next_closed = kNoHit;
  for (const auto& [height, crossing] : crossings) {
    if (height <= range.limit) continue;
    if (static_receivers || crossing == Crossing::open)
      next_open = std::min(next_open, height);
    else if (crossing == Crossing::enters)
      next_closed = std::min(next_closed, height);
  }
  range.next = static_receivers ? range.limit : std::min(next_open, next_closed);
  range.next_limit = next_closed < next_open ? leave_bodies(next_closed) : next_open;
  return range;
}

DirectDepths::DirectDepths(const SnappedCasters& casters, const LightGrid& grid, const DirectOptions& options)
    : casters_(casters), grid_(grid), options_(options), log2_bin_(grid.log2_size > 8 ? grid.log2_size - 8 : 0) {
  const int32_t bins = int32_t(grid_.size() >> log2_bin_), bin = kSubVoxels << log2_bin_;
  bins_.resize(size_t(bins) * size_t(bins));
  for (uint32_t t = 0; t < casters.triangles.size(); ++t) {
    const glm::ivec3* c = casters.triangles[t].corners;
    const glm::ivec3 low = glm::min(c[0], glm::min(c[1], c[2])), high = glm::max(c[0], glm::max(c[1], c[2]));
    for (int32_t y = std::max(low.y, 0) / bin; y < bins && y * int64_t(bin) <= high.y; ++y)
      for (int32_t x = std::max(low.x, 0) / bin; x < bins && x * int64_t(bin) <= high.x; ++x)
        bins_[size_t(y) * size_t(bins) + size_t(x)].push_back(t);
  }
}

TexelRange DirectDepths::raw_range(int32_t x, int32_t y) const {
  std::vector<std::pair<int32_t, Crossing>> crossings;
  const size_t bin = (size_t(y) >> log2_bin_) * (grid_.size() >> log2_bin_) + (size_t(x) >> log2_bin_);
  const int64_t px = texel_center(x), py = texel_center(y);
  for (const uint32_t t : bins_[bin]) {
    const SnappedTriangle& triangle = casters_.triangles[t];
    if (covers(triangle, px, py)) crossings.emplace_back(int32_t(exact_height(triangle, px, py)), triangle.crossing);
  }
  return range_of_crossings(crossings, options_.static_receivers);
}

std::vector<TexelRange> DirectDepths::ranges(int32_t x, int32_t y, int32_t width, int32_t height) const {
  const int32_t reach = int32_t(options_.max_filter / 2), size = int32_t(grid_.size()), depth = int32_t(grid_.depth());
  const int32_t wide = width + 2 * reach, high = height + 2 * reach;
  std::vector<TexelRange> raw(size_t(wide) * size_t(high));
  for (int32_t j = 0; j < high; ++j)
    for (int32_t i = 0; i < wide; ++i) {
      const int32_t tx = x - reach + i, ty = y - reach + j;
      if (tx >= 0 && ty >= 0 && tx < size && ty < size) raw[size_t(j) * size_t(wide) + size_t(i)] = raw_range(tx, ty);
    }
  std::vector<TexelRange> result;
  for (int32_t j = 0; j < height; ++j)
    for (int32_t i = 0; i < width; ++i) {
      const TexelRange& own = raw[size_t(j + reach) * size_t(wide) + size_t(i + reach)];
      int32_t least = kNoHit, raised = kNoHit;
      for (int32_t dy = 0; dy <= 2 * reach; ++dy)
        for (int32_t dx = 0; dx <= 2 * reach; ++dx) {
          const TexelRange& other = raw[size_t(j + dy) * size_t(wide) + size_t(i + dx)];
          least = std::min(least, other.limit);
          raised = std::min(raised, other.next <= own.first ? other.next_limit : other.limit);
        }
      int32_t limit = std::max(least, std::min(raised, own.limit));
      const int32_t first = std::clamp(own.first, 0, depth);
      if (limit != kNoHit) limit -= options_.margin;
      result.push_back({.first = first, .limit = std::clamp(limit, first, depth)});
    }
  return result;
}

}  // namespace shadewright::voxel
