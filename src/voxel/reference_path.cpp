#include "reference_path.h"

#include <algorithm>
#include <vector>

namespace shadewright::voxel {

namespace {

struct Bounds {
  int32_t first_min, first_max, limit_min, limit_max;
};

class MinMaxPath {
 public:
  MinMaxPath(DagBuilder& builder, std::span<const int32_t> first, std::span<const int32_t> limit)
      : builder_(builder), first_(first), limit_(limit), log2_size_(builder.log2_size()) {
    build_hierarchy();
  }

  Value run(const Progress& progress) {
    progress("DAG", 0.0);
    const Value root = build(log2_size_, 0, 0, 0);
    progress("DAG", 1.0);
    return root;
  }

 private:
  size_t texel(uint32_t x, uint32_t y) const { return (size_t(y) << log2_size_) + x; }

  void build_hierarchy() {
    const uint32_t side = 1u << (log2_size_ - kSlabHeight);
    std::vector<Bounds> level(size_t(side) * side);
    for (uint32_t y = 0; y < side; ++y)
      for (uint32_t x = 0; x < side; ++x) {
        Bounds bounds{INT32_MAX, INT32_MIN, INT32_MAX, INT32_MIN};
        for (uint32_t t = 0; t < 64; ++t) {
          const size_t at = texel(x * 8 + (t & 7), y * 8 + (t >> 3));
          bounds = {std::min(bounds.first_min, first_[at]), std::max(bounds.first_max, first_[at]),
                    std::min(bounds.limit_min, limit_[at]), std::max(bounds.limit_max, limit_[at])};
        }
        level[size_t(y) * side + x] = bounds;
      }
    hierarchy_.push_back(std::move(level));
    for (uint32_t half = side / 2; half > 0; half /= 2) {
      const std::vector<Bounds>& fine = hierarchy_.back();
      std::vector<Bounds> coarse(size_t(half) * half);
      for (uint32_t y = 0; y < half; ++y)
        for (uint32_t x = 0; x < half; ++x) {
          Bounds bounds = fine[size_t(2 * y) * (2 * half) + 2 * x];
          for (uint32_t i = 1; i < 4; ++i) {
            const Bounds& other = fine[size_t(2 * y + (i >> 1)) * (2 * half) + 2 * x + (i & 1)];
            bounds = {std::min(bounds.first_min, other.first_min), std::max(bounds.first_max, other.first_max),
                      std::min(bounds.limit_min, other.limit_min), std::max(bounds.limit_max, other.limit_max)};
          }
          coarse[size_t(y) * half + x] = bounds;
        }
      hierarchy_.push_back(std::move(coarse));
    }
  }

  /// The volume at (x, y, z) * 2^height.
  Value build(uint32_t height, uint32_t x, uint32_t y, uint32_t z) {
    const Bounds& bounds = hierarchy_[height - kSlabHeight][(size_t(y) << (log2_size_ - height)) + x];
    const int64_t begin = int64_t(z) << height, end = begin + (int64_t(1) << height);
    if (end <= bounds.first_min) return kAllVisible;
    if (begin >= bounds.limit_max) return kAllShadowed;
    if (begin >= bounds.first_max && end <= bounds.limit_min) return kAllUndefined;
    std::array<Value, 8> children;
    if (height > kSlabHeight) {
      for (uint32_t c = 0; c < 8; ++c)
        children[c] = build(height - 1, 2 * x + (c & 1), 2 * y + (c >> 1 & 1), 2 * z + (c >> 2));
      return builder_.octant_node(height, children);
    }
    for (uint32_t c = 0; c < 8; ++c) children[c] = leaf(x * 8, y * 8, int32_t(begin) + int32_t(c));
    return builder_.slab_node(children);
  }

  Value leaf(uint32_t x, uint32_t y, int32_t z) {
    uint64_t visible = 0, shadowed = 0;
    for (uint32_t t = 0; t < 64; ++t) {
      const size_t at = texel(x + (t & 7), y + (t >> 3));
      visible |= uint64_t(z < first_[at]) << t;
      shadowed |= uint64_t(z >= limit_[at]) << t;
    }
    return builder_.resolved_leaf(visible, shadowed);
  }

  DagBuilder& builder_;
  std::span<const int32_t> first_, limit_;
  uint32_t log2_size_;
  std::vector<std::vector<Bounds>> hierarchy_;  ///< [height - 3]
};

}  // namespace

Value build_from_maps(DagBuilder& builder, std::span<const int32_t> first, std::span<const int32_t> limit,
                      const Progress& progress) {
  return MinMaxPath(builder, first, limit).run(progress);
}

}  // namespace shadewright::voxel
