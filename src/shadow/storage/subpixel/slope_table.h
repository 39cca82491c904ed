// The decoded slopes of a sub-pixel shadow map (SPSM equation 4), and how far each may be off.
#pragma once

#include <span>
#include <string_view>

#include "shadow/storage/subpixel/shared.h"

namespace shadewright::shadow {

/// "power" is the paper's (8 bits, fifth power), "linear" its straw man, "wide" has 11 bits and a depth within the
/// texel.
shared::SlopeCoding slope_coding(std::string_view name);

/// How many slopes there are: all codes but the one that marks edge lines.
uint32_t slope_codes(const shared::SlopeCoding& coding);

/// Equation 3: the code of a slope.
uint32_t encode_slope(const shared::SlopeCoding& coding, double slope);

/// Fills `entries`, one a code.
void make_slope_table(const shared::SlopeCoding& coding, std::span<shared::SlopeEntry> entries);

}  // namespace shadewright::shadow
