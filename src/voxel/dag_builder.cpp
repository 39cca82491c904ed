#include "dag_builder.h"

#include <algorithm>

namespace shadewright::voxel {

DagBuilder::DagBuilder(uint32_t log2_size, MemoryBudget& budget) : log2_size_(log2_size), leaves_(budget) {
  for (uint32_t height = kSlabHeight; height <= log2_size; ++height) pools_.emplace_back(budget);
}

Value DagBuilder::leaf(uint64_t visible_mask) {
  if (visible_mask == 0) return kAllShadowed;
  if (visible_mask == ~uint64_t(0)) return kAllVisible;
  return kFirstNode + leaves_.insert(visible_mask);
}

Value DagBuilder::resolved_leaf(uint64_t visible, uint64_t shadowed) {
  if (shadowed == 0) return visible != 0 ? kAllVisible : kAllUndefined;
  return leaf(visible);
}

Value DagBuilder::insert(uint32_t height, std::array<Value, 8>& children) {
  resolve_undefined(children);
  if (!is_node(children[0]) && std::all_of(children.begin(), children.end(), [&](Value v) { return v == children[0]; }))
    return children[0];
  std::array<uint32_t, 9> words{};
  uint32_t count = 1;
  Value last = kAllUndefined;  // of the children with a pointer
  for (uint32_t child = 0; child < 8; ++child) {
    const Value value = children[child];
    if (!is_node(value)) {
      words[0] |= value << (2 * child);
      continue;
    }
    const bool shared = height == kSlabHeight ? value == last : child >= 4 && value == children[child & 3];
    words[0] |= (shared ? kSharedPointer : kOwnPointer) << (2 * child);
    if (!shared) words[count++] = value - kFirstNode;
    last = value;
  }
  return kFirstNode + pools_[height - kSlabHeight].insert({words.data(), count});
}

Value DagBuilder::slab_node(std::array<Value, 8> slabs) {
  return insert(kSlabHeight, slabs);
}

Value DagBuilder::octant_node(uint32_t height, std::array<Value, 8> octants) {
  return insert(height, octants);
}

Value DagBuilder::flat(uint32_t height, int64_t z, const FlatCut& cut) {
  const int64_t end = z + (int64_t(1) << height);
  const bool may_shadow = z >= cut.shadowed_from, may_show = end <= cut.visible_to;
  if (may_shadow && may_show) return kAllUndefined;
  if (may_show) return kAllVisible;
  if (may_shadow) return kAllShadowed;
  std::array<Value, 8> children;
  if (height == kSlabHeight) {
    for (int64_t i = 0; i < 8; ++i) {
      const bool visible = z + i + 1 <= cut.visible_to, shadowed = z + i >= cut.shadowed_from;
      children[size_t(i)] = visible && shadowed ? kAllUndefined : visible ? kAllVisible : kAllShadowed;
    }
  } else {
    const int64_t half = int64_t(1) << (height - 1);
    std::fill(children.begin(), children.begin() + 4, flat(height - 1, z, cut));
    std::fill(children.begin() + 4, children.end(), flat(height - 1, z + half, cut));
  }
  return insert(height, children);
}

}  // namespace shadewright::voxel
