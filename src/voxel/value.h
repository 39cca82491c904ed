// What is known of a volume while the DAG is built: one state for all its voxels, or the number of a shared node.
#pragma once

#include <array>
#include <cstdint>

namespace shadewright::voxel {

/// A volume's content: `kAllShadowed`, `kAllVisible`, `kAllUndefined`, or kFirstNode + the pool's id of its node.
using Value = uint32_t;
inline constexpr Value kAllShadowed = 0, kAllVisible = 1, kAllUndefined = 2, kFirstNode = 3;

inline bool is_node(Value value) {
  return value >= kFirstNode;
}

/// The paper's rule for undefined children (section 6.1): all undefined stays so; otherwise they become visible if some
/// child is visible and none shadowed, else shadowed.
inline void resolve_undefined(std::array<Value, 8>& children) {
  bool undefined = false, visible = false, shadowed = false, node = false;
  for (const Value child : children) {
    undefined |= child == kAllUndefined;
    visible |= child == kAllVisible;
    shadowed |= child == kAllShadowed;
    node |= is_node(child);
  }
  if (!undefined || (!visible && !shadowed && !node)) return;
  const Value resolved = visible && !shadowed ? kAllVisible : kAllShadowed;
  for (Value& child : children)
    if (child == kAllUndefined) child = resolved;
}

}  // namespace shadewright::voxel
