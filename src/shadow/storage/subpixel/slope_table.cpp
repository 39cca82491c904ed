#include "shadow/storage/subpixel/slope_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shadewright::shadow {

namespace {

/// Equation 4 for any place between codes, and short of infinity, which the outermost codes reach.
double decode(const shared::SlopeCoding& coding, double code) {
  const double middle = 0.5 * (slope_codes(coding) - 1);
  const double s = code / middle - 1;
  const double angle = std::pow(std::min(std::abs(s), 1 - 0.25 / middle), 1.0 / static_cast<double>(coding.exponent));
  return std::copysign(std::tan(0.5 * std::numbers::pi * angle), s);
}

}  // namespace

shared::SlopeCoding slope_coding(std::string_view name) {
  if (name == "power") return {8, 5, 1};
  if (name == "linear") return {8, 1, 1};
  return {11, 1, 0};
}

uint32_t slope_codes(const shared::SlopeCoding& coding) {
  return (1u << coding.bits) - 1;
}

uint32_t encode_slope(const shared::SlopeCoding& coding, double slope) {
  const double middle = 0.5 * (slope_codes(coding) - 1);
  const double t = 2 / std::numbers::pi * std::atan(slope);
  return static_cast<uint32_t>(
      std::lround(middle * (1 + std::copysign(std::pow(std::abs(t), static_cast<double>(coding.exponent)), t))));
}

void make_slope_table(const shared::SlopeCoding& coding, std::span<shared::SlopeEntry> entries) {
  const uint32_t codes = slope_codes(coding);
  for (uint32_t code = 0; code < codes; ++code) {
    // A code stands for all slopes that round to it: those up to half a code away.
    const double slope = decode(coding, code);
    const double above = decode(coding, std::min(code + 0.5, codes - 1.0)) - slope;
    const double below = slope - decode(coding, std::max(code - 0.5, 0.0));
    entries[code] = {static_cast<float>(slope), static_cast<float>(std::max(above, below))};
  }
}

}  // namespace shadewright::shadow
