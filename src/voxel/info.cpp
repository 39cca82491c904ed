#include "shadewright/voxel/info.h"

namespace shadewright::voxel {

std::vector<LevelCounts> count_levels(const VoxelShadow& shadow, size_t which) {
  const DagView& dag = shadow.dags()[which];
  const std::span<const uint64_t> starts = shadow.level_starts(which);
  std::vector<LevelCounts> levels;
  // How many nodes of the tree each node stands for.
  std::vector<double> times(dag.nodes.size(), 0.0);
  for (const uint32_t cell : dag.grid)
    if (cell > kVisible) times[cell] += 1;
  double leaves = 0;
  for (size_t i = 0; i + 1 < starts.size(); ++i) {
    LevelCounts level;
    level.height = dag.log2_size - dag.log2_grid - uint32_t(i);
    level.bytes = 4 * (starts[i + 1] - starts[i]);
    const bool slabs = level.height == kSlabHeight;
    for (uint64_t at = starts[i]; at < starts[i + 1]; at += node_words(dag.nodes[at])) {
      const uint32_t header = dag.nodes[at];
      ++level.merged;
      level.unmerged += times[at];
      for (uint32_t child = 0; child < 8; ++child) {
        if (child_code(header, child) < kOwnPointer) continue;
        double& below = slabs ? leaves : times[dag.nodes[at + 1 + pointer_index(header, child, true)]];
        below += times[at];
      }
    }
    levels.push_back(level);
  }
  levels.push_back({0, leaves, dag.leaves.size(), dag.leaves.size_bytes()});
  return levels;
}

}  // namespace shadewright::voxel
