// What a map holds, for people.
#pragma once

#include <vector>

#include "shadewright/gpu/resources.h"
#include "shadewright/image/picture.h"
#include "shadow/caster_draws.h"

namespace shadewright::shadow {

/// The first float of each texel, which has `texel_bytes`, layers one below the other; `empty` in layers that hold
/// nothing. Waits; leaves the map in shader-read layout.
std::vector<float> map_values(const gpu::Device& device, gpu::Image& map, uint32_t texel_bytes,
                              const CasterDraws& draws, float empty);

/// Of a map of depths: near bright and empty (1) black, layers one below the other. Waits; leaves the map in
/// shader-read layout.
Picture depth_picture(const gpu::Device& device, gpu::Image& map, const CasterDraws& draws);

}  // namespace shadewright::shadow
