// The paper's own construction (CPVS, section 6.1): top-down, from maps of depths and their min-max hierarchies.
// Holds N² texels: for tests, and for maps that come from elsewhere.
#pragma once

#include <cstdint>
#include <span>

#include "dag_builder.h"
#include "shadewright/progress.h"

namespace shadewright::voxel {

/// A voxel (x, y, z) is visible when z < first[x, y], shadowed when z >= limit[x, y], undefined between. Both maps have
/// 2^n x 2^n texels, row by row, in 0..2^n; first <= limit. Returns the value of the whole volume; undefined nodes
/// follow section 6.1.
Value build_from_maps(DagBuilder& builder, std::span<const int32_t> first, std::span<const int32_t> limit,
                      const Progress& progress);

}  // namespace shadewright::voxel
