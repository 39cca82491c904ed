// The codes of a sub-pixel shadow map's texel, for C++ and GLSL (SPSM section 3.3 and 3.4).
//
// r, g, b   a vertex each, x and y signed 15 bits of 1/256 texel around the texel's centre; of a triangle that reaches
//           farther an edge line each: angle 15 bits, distance 12 bits of 1/256 texel, 4 bits of the slope along x.
//           Bit 15: the edge (from that vertex to the next one) is a silhouette. Bit 31 of b: triangle_averted.
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
/// Half a texel, and what the rounding of vertices to 1/256 texel may move them.
const float half_texel = 0.50390625f;
/// The rasterizer snaps to 1/256 texel: this much more, so that no touched texel's centre is lost.
const float conservative_reach = half_texel + 0.015625f;
/// Of a triangle: a closed body's side that looks away from the light. Below it there is a bit a silhouette edge.
const uint triangle_averted = 8;

/// One decoded slope, and half the gap to the farther of its neighbours: no slope of this code is farther off.
struct SlopeEntry {
  float slope;
  float error;
};

/// Besides the map, what drawing and look-up read: the slopes from a uniform buffer, which a CPU device reads faster.
struct SubpixelSlopes {  // 16 KB, what every device lets a uniform buffer hold
  SlopeEntry slopes[max_slope_codes];
};
struct SubpixelTangents {
  uint tangent_counts[512];  // by pattern of occluded texels: how many tangents, or one of the two below
  vec2 tangents[2048];       // four a pattern: unit normals into the shadow
};
const uint tangents_lit = 0, tangents_shadowed = 5;

/// A triangle of at most small_reach texels along x and y.
struct SmallTriangle {
  uint base;         // texel, signed x and y in 16 bits each, from whose lower corner the vertices count
  uint vertices[3];  // as a texel codes them, with the silhouettes and the averted bit
  vec3 depths;       // theirs
  uint slopes;       // codes of the slopes along x and y, 16 bits each
};
const float small_reach = 12.0f;
/// Those of a visible instance among all.
struct SmallList {
  uint begin, end;
};
/// A square of texels in which there may be some of small triangles; none of these meets more than four.
const uint small_tile = 16;
/// VkDrawIndirectCommand: six vertices for each of these tiles, which are listed behind it.
struct SmallTiles {
  uint vertex_count;
  uint count;
  uint first_vertex, first_instance;
};
/// LookupData::recovery.
const uint recovery_off = 0, recovery_silhouettes = 1, recovery_tangents = 2;

/// How a receiver was decided (figure 14): by the texel that it lies in, the 3x3 around it, or silhouette recovery.
const uint decided_by_one_texel = 1, decided_by_neighbours = 2, decided_by_recovery = 3;
const uint decided_lit = 4;  // added where the answer is light

#ifdef __cplusplus
}  // namespace shadewright::shared
#endif
#endif
