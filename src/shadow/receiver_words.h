// Asks a debug shader about every receiver of a frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shadow/parameterization/parameterization.h"

namespace shadewright::shadow {

/// What a compute shader of 8 x 8 pixels a group, with the receivers at bindings 0 to 2 (shadow/receivers.glsl), writes
/// to the storage buffer at binding 3: one word a pixel, row by row. Its specialization constant 0, if it has
/// one, is the light's kind. Submits and waits.
std::vector<uint32_t> receiver_words(const gpu::Device& device, std::span<const uint32_t> spirv,
                                     const ReceiverLookup& lookup);

}  // namespace shadewright::shadow
