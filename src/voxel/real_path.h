// Builds the DAG straight from triangles, without ever holding an N² map: recursion over squares of texels ("quads"),
// each with the triangles that overlap it (techniques.md, section 6). A quad that no silhouette edge crosses is covered
// by whole sheets of triangles. Conservative bounds then decide most quads at once: shadowed past the far side of the
// first sheet, visible before the near side of the surface where the undefined region ends. Only quads with silhouettes
// or thin parts go on, down to tiles that are rasterized exactly.
#pragma once

#include <atomic>
#include <cstdint>

#include "dag_builder.h"
#include "shadewright/progress.h"
#include "shadewright/voxel/bake.h"
#include "snapped.h"
#include "tile.h"

namespace shadewright::voxel {

struct RealPathCounts {
  std::atomic<uint64_t> quads{0}, tiles{0}, stabbed{0};
};

/// The value of the whole volume. Runs in the calling thread's task arena; what it makes does not depend on the
/// threads.
Value build_from_triangles(DagBuilder& builder, const SnappedCasters& casters, const TileRules& rules,
                           Resolving resolving, MemoryBudget& budget, RealPathCounts& counts, const Progress& progress);

}  // namespace shadewright::voxel
