// Is a baked shadow right? Random voxels against direct depth comparison with exact arithmetic.
#pragma once

#include <cstdint>

#include "shadewright/voxel/bake.h"

namespace shadewright::voxel {

struct CheckResult {
  uint64_t asked = 0;      ///< voxels that are defined, of those drawn
  uint64_t undefined = 0;  ///< drawn, but any answer is right
  uint64_t wrong = 0;
};

/// Draws at least `samples` voxels in squares of 32 x 32 texels around random points of the window and of random
/// triangles; half of them next to where visibility or definedness changes. `options` are those of the bake.
/// Deterministic for a seed.
CheckResult check_shadow(const Scene& scene, const VoxelShadow& shadow, const BakeOptions& options, uint64_t samples,
                         uint32_t seed = 1, const Progress& progress = no_progress);

}  // namespace shadewright::voxel
