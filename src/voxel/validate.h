// Checks that a DAG from elsewhere is one: after this no look-up can leave its arrays.
#pragma once

#include <cstdint>
#include <span>

#include "shadewright/voxel/dag.h"

namespace shadewright::voxel {

/// True when every grid cell and every pointer names the beginning of a node of the height below (or a leaf), and every
/// node's codes and words fit. Linear time.
bool is_sound(const DagView& dag, std::span<const uint64_t> level_starts);

}  // namespace shadewright::voxel
