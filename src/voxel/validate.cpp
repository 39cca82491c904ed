#include "validate.h"

#include <algorithm>
#include <vector>

namespace shadewright::voxel {

namespace {

/// Every child with a shared pointer has a child before it that owns one.
bool codes_fit(uint32_t header, bool octants) {
  bool owned = false;
  for (uint32_t child = 0; child < 8; ++child) {
    const uint32_t code = child_code(header, child);
    if (code == kSharedPointer)
      if (octants ? child < 4 || child_code(header, child & 3) != kOwnPointer : !owned) return false;
    owned = owned || code == kOwnPointer;
  }
  return true;
}

}  // namespace

bool is_sound(const DagView& dag, std::span<const uint64_t> starts) {
  if (dag.log2_size < 6 || dag.log2_size > 20 || dag.log2_grid < 1 || dag.log2_grid > std::min(7u, dag.log2_size - 3))
    return false;
  const size_t levels = dag.log2_size - dag.log2_grid - kSlabHeight + 1;
  if (dag.grid.size() != size_t(1) << (3 * dag.log2_grid) || starts.size() != levels + 1) return false;
  if (starts[0] != kNodePadding || !std::is_sorted(starts.begin(), starts.end()) || starts.back() > dag.nodes.size() ||
      dag.nodes.size() - starts.back() != kNodePadding)
    return false;
  std::vector<bool> begins(dag.nodes.size(), false);
  for (size_t level = 0; level < levels; ++level)
    for (uint64_t at = starts[level]; at < starts[level + 1];) {
      const uint32_t header = dag.nodes[at];
      if (!codes_fit(header, level + 1 < levels)) return false;
      begins[at] = true;
      at += node_words(header);
      if (at > starts[level + 1]) return false;
    }
  const auto names_node = [&](uint32_t pointer, size_t level) {
    return pointer >= starts[level] && pointer < starts[level + 1] && begins[pointer];
  };
  for (size_t level = 0; level < levels; ++level)
    for (uint64_t at = starts[level]; at < starts[level + 1]; at += node_words(dag.nodes[at]))
      for (uint64_t word = at + 1; word < at + node_words(dag.nodes[at]); ++word) {
        const uint32_t pointer = dag.nodes[word];
        if (level + 1 < levels ? !names_node(pointer, level + 1) : pointer >= dag.leaves.size()) return false;
      }
  return std::all_of(dag.grid.begin(), dag.grid.end(),
                     [&](uint32_t cell) { return cell <= kVisible || names_node(cell, 0); });
}

}  // namespace shadewright::voxel
