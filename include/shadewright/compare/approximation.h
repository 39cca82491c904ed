// What simplified geometry costs: one view of a scene and of an approximation of it (far instances as points).
#pragma once

#include <cstdint>
#include <span>

#include "shadewright/raytrace/tracer.h"

namespace shadewright::compare {

/// Counts of pixels.
struct ApproximationError {
  uint64_t compared = 0;  ///< show, exactly, geometry that faces the light
  uint64_t wrong = 0;     ///< of them, lit in one image and not in the other (turned away from the light is not lit)
  uint64_t coverage = 0;  ///< background in one image only
  double fraction = 0;    ///< wrong / compared; 0 of nothing

  /// Lit shares of the pixels that face the light, in each image: what density of foliage lets through.
  double lit_exact = 0, lit_shown = 0;
};

/// Both images row by row, of the same size. `exact_visible` is the traced truth (0 or 1) of `exact`; `shown_visible`
/// is the truth of `shown`, or a technique's visibility (lit from 0.5).
ApproximationError approximation_error(std::span<const SurfacePoint> exact, std::span<const uint8_t> exact_visible,
                                       std::span<const SurfacePoint> shown, std::span<const float> shown_visible,
                                       const Light& light);

}  // namespace shadewright::compare
