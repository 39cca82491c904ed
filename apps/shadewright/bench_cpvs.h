// The tables of "Compact Precomputed Voxelized Shadows" (2014) that need no GPU: figure 9, build times, look-up ratios.
#pragma once

#include <cstdint>
#include <vector>

#include "bench_table.h"
#include "shadewright/progress.h"

namespace shadewright::app {

struct CpvsBench {
  uint32_t limit = 65536;              ///< largest resolution to bake
  uint64_t check_voxels = 10'000'000;  ///< random voxels to compare with exact depths, a scene
};

std::vector<BenchTable> bench_cpvs(const CpvsBench& options, const Progress& progress);

}  // namespace shadewright::app
