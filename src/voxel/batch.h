// Filtered visibility of many world points.
#pragma once

#include <span>

#include "shadewright/voxel/shadow.h"

namespace shadewright::voxel {

void look_up(const DagView& dag, const LightGrid& light, std::span<const SurfacePoint> points, uint32_t taps,
             std::span<float> result);

}  // namespace shadewright::voxel
