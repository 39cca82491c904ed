// Asks a shader about every receiver of a frame, and reads what it answers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shadow/parameterization/parameterization.h"

namespace shadewright::shadow {

/// What a compute shader of 8 x 8 pixels a group, with the receivers at bindings 0 to 2 (shadow/receivers.glsl), writes
/// to each of `outputs` storage buffers from binding 3 on: `bytes` a pixel, row by row, of a strip of the image
/// (shadow/receiver_strip.glsl). Its specialization constant 0, if it has one, is the light's kind. Submits and waits.
std::vector<std::vector<std::byte>> receiver_answers(const gpu::Device& device, std::span<const uint32_t> spirv,
                                                     const ReceiverLookup& lookup, uint32_t outputs, uint32_t bytes);

/// The same for one output of a word.
std::vector<uint32_t> receiver_words(const gpu::Device& device, std::span<const uint32_t> spirv,
                                     const ReceiverLookup& lookup);

}  // namespace shadewright::shadow
