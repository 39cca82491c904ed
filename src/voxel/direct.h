// Visibility by direct depth comparison, one texel at a time with exact integers: the truth that bakes are tested
// against. Shares only the snapped triangles and the sampling rule with the real path.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sampling.h"
#include "snapped.h"

namespace shadewright::voxel {

struct DirectOptions {
  bool static_receivers = false;
  uint32_t max_filter = 1;
  int32_t margin = 0;  ///< see `filter_margin`
};

/// First depth and end of the undefined region before the filter's window: for one texel, from all its crossings.
/// Heights stand for depths: crossings within the same half voxels count as one depth.
TexelRange range_of_crossings(std::span<const std::pair<int32_t, Crossing>> crossings, bool static_receivers);

class DirectDepths {
 public:
  DirectDepths(const SnappedCasters& casters, const LightGrid& grid, const DirectOptions& options);
  /// Ranges of the texels [x, x + width) x [y, y + height), row by row, clamped to 0..depth.
  std::vector<TexelRange> ranges(int32_t x, int32_t y, int32_t width, int32_t height) const;

 private:
  TexelRange raw_range(int32_t x, int32_t y) const;

  const SnappedCasters& casters_;
  LightGrid grid_;
  DirectOptions options_;
  uint32_t log2_bin_;
  std::vector<std::vector<uint32_t>> bins_;
};

}  // namespace shadewright::voxel
