// Cuts an image into strips of rows for passes that write more than a storage binding holds.
#pragma once

#include <cstdint>
#include <vector>

#include "shadow/shared.h"

namespace shadewright::shadow {

/// The largest side of a work group of such a pass.
constexpr uint32_t strip_alignment = 8;

/// Strips that hold at most `most_pixels` each, of an image of `height` rows of `width` pixels: none are lost and none
/// are in two. All but the last have a multiple of `strip_alignment` rows; no strip has fewer for want of room.
std::vector<shared::ReceiverStrip> receiver_strips(uint32_t width, uint32_t height, uint64_t most_pixels);

}  // namespace shadewright::shadow
