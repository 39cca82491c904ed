// The error of a visibility image against the ray-traced reference (architecture, section 6).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "shadewright/compare/report.h"
#include "shadewright/raytrace/tracer.h"

namespace shadewright::compare {

/// All images are width x height, row by row.
struct MetricsInput {
  uint32_t width = 0, height = 0;
  std::span<const SurfacePoint> points;  ///< the camera pass's; needed only with texel_u and texel_v
  glm::vec3 eye{0.0f};                   ///< the camera's, for the float error of points (`position_error`)
  std::span<const uint8_t> facing;       ///< 1 = compared: geometry whose normal faces the light (see `facing_light`)
  std::span<const float> visibility;     ///< the technique's, 0..1
  std::span<const uint8_t> reference;    ///< 0 or 1
  std::span<const float> reference_filtered;  ///< supersampled, 0..1; empty = mean_absolute is against `reference`
  std::span<const uint8_t> oracle;            ///< 0 or 1; empty = no oracle_fraction
  /// World-space half extents of the map's texel on the receiver (two vectors a pixel), for what counts as thinner than
  /// a texel; empty = no pixel is excepted.
  std::span<const glm::vec3> texel_u, texel_v;
};

/// How a visibility is thresholded wherever a figure needs yes or no.
constexpr bool lit(float visibility) {
  return visibility >= 0.5f;
}

/// A surface with a smaller cosine to the light is edge-on to it: normals are known no better (octahedral, 16 bits),
/// and whether it faces the light is a matter of rounding.
inline constexpr double edge_on_cosine = 1e-4;

/// 1 for points that are valid and whose normal faces the light (cosine > edge_on_cosine; inside the cone, for a spot).
std::vector<uint8_t> facing_light(std::span<const SurfacePoint> points, const Light& light);

/// The figures of section 6, `flicker` excepted (it needs two frames, see flicker.h). Ratios of nothing are 0.
/// InputError when an image's size is not width * height.
///
/// `interior_*` count wrong pixels more than 3 pixels (Euclidean) from every reference edge, except where the truth
/// itself changes within one texel of the point: there a feature is thinner than the map resolves. `tracer` answers
/// that at 5 x 5 points of the receiver's plane, half a texel apart and one texel to each side: position + a * texel_u
/// + b * texel_v, with a and b in {-2, -1, 0, 1, 2} half extents.
ErrorFigures measure_error(const MetricsInput& input, const Tracer& tracer, const Light& light);

/// 1 for pixels that count as wrong, else 0.
std::vector<uint8_t> wrong_pixels(const MetricsInput& input);

/// The figures of several frames as those of one: counts are added, fractions and means are over all their pixels.
/// No oracle_fraction unless every frame has one, and no flicker.
ErrorFigures total(std::span<const ErrorFigures> frames);

}  // namespace shadewright::compare
