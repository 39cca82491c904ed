// Fits a light's voxel volume to what it has to cover.
#pragma once

#include "casters.h"
#include "shadewright/voxel/bake.h"
#include "shadewright/voxel/light_grid.h"

namespace shadewright::voxel {

/// The window covers `bounds` (or all casters); its depth reaches from the first caster inside the window to the last
/// point of the bounds. Spots: the window is the cone's square. InputError for point lights and windows without
/// casters.
LightGrid fit_light(const Casters& casters, const Light& light, const BakeOptions& options);

}  // namespace shadewright::voxel
