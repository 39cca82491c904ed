// The codes of a sub-pixel shadow map's texel, for C++ and GLSL (SPSM section 3.3 and 3.4).
//
// r, g, b   the triangle's vertices, signed 16 bits each of 1/256 texel around the texel's centre; of a triangle that
// reaches
//           farther, three edge lines: angle 16 bits, distance 12 bits of 1/256 texel, and 4 bits of its slope along x
// a         slope along x, slope along y, depth at the texel's centre: 8, 8, 16 bits (the paper's), or 11, 11, 10 bits
// The slope code along x of all ones marks edge lines.
// Slopes are in texels of depth a texel: 1 is 45 degrees. They are quantized as angles (equations 2 to 4), whose power
// function is the table's business: the look-up decodes by the table that `make_slope_table` fills.
#ifndef SHADEWRIGHT_SUBPIXEL_SHARED_H
#define SHADEWRIGHT_SUBPIXEL_SHARED_H

#include "shadow/shared.h"

#ifdef __cplusplus
namespace shadewright::shared {
#endif

const uint max_slope_codes = 2047;

/// How slopes and depth are coded. `exponent` is the paper's n.
struct SlopeCoding {
  uint bits;            // of one slope: 8 or 11
  float exponent;       // of the power function of the angle; 1 is linear
  uint absolute_depth;  // 1: 16 bits over the map's whole range; 0: 10 bits within the texel, from the minimum depth on
};

/// One decoded slope, and half the gap to the farther of its neighbours: no slope of this code is farther off.
struct SlopeEntry {
  float slope;
  float error;
};

/// What the look-up of a sub-pixel shadow map reads besides the map.
struct SubpixelTables {
  SlopeCoding coding;
  uint recovery;  // 0: uncertain receivers are lit
  SlopeEntry slopes[max_slope_codes];
  uint tangent_counts[512];  // by pattern of occluded texels: how many tangents, or one of the two below
  vec2 tangents[2048];       // four a pattern: unit normals into the shadow
};
const uint tangents_lit = 0, tangents_shadowed = 5;

#ifdef __cplusplus
}  // namespace shadewright::shared
#endif
#endif
