// Structs of the rectilinear warp and of the casters drawn through it, for C++ and GLSL.
//
// Spaces of the light's image plane: *map* is that of the view's matrix; *whole* is it turned (an Orientation), with
// what may receive in [0, 1]; *flat* is whole cut to what receives in this frame, which fills [0, 1]; *warped* is where
// the shadow map's texels lie. Flat and warped differ by one piecewise linear function an axis. Its shares come from
// `cells` super-cells of the same flat size; its segments are those, or runs of them that deserve about the same.
#ifndef SHADEWRIGHT_RECTILINEAR_SHARED_H
#define SHADEWRIGHT_RECTILINEAR_SHARED_H

#include "render/shared.h"

#ifdef __cplusplus
namespace shadewright::shared {
#endif

/// One way to turn the light's image plane: whole = (dot(u, (map, 1)), dot(v, (map, 1))), and metres (of a spot light:
/// tangents) = offset + whole * size.
struct Orientation {
  vec3 u, v;
  vec2 offset, size;
};

const uint max_orientations = 32, orientation_samples = 64;  // an axis of the picture
/// How finely importance is accumulated along the whole of an axis; super-cells are cut from these.
const uint importance_bins = 4096, max_cells = 2048, max_cut_segments = 64;

/// Importance functions, as bits of the specialization constant `functions` (known.glsl).
const uint importance_distance = 1, importance_normal = 2, importance_pixels = 4, importance_edges = 8,
           importance_view = 16;
/// From the importance of a row to its share of the map.
const uint collapse_max = 0, collapse_sum = 1;

/// Host-written, a frame.
struct WarpConstants {
  Orientation orientations[max_orientations];
  uint orientation_count;
  float normal_weight;  // of importance_normal
  float flat_weight;    // of importance_edges, where there is no edge
  uint cells;
  float sigma;  // of the blur, super-cells
  float temporal;
  uint history_holds;  // last frame's light was the same
  uint resolution;
  float sum_scale;  // sums are whole numbers: so much is 1
  uint forward;     // importance comes from the light's depth image: nothing is cut
  uint image_size;  // of that image
  uint map_size;    // of the two-dimensional importance map; 0: there is none
  float longest_edge;
  uint max_segments;  // 0: every super-cell is one
};

/// Accumulated over a frame's samples. Floats of [0, inf) as their bits, which are in the same order; 0 where nothing
/// was.
struct Importance {
  uint best_orientation;  // ~(bits of its error, the last five the orientation): the least error is the greatest
  uint low_inverted[2];   // ~bits of the least coordinate, along u and v
  uint high[2];
  uint greatest[2 * importance_bins];
  uint sums[2 * importance_bins];
};

/// The orientation that `best_orientation` names; the first where nothing was seen.
#ifdef __cplusplus
inline
#endif
    uint
    orientation_index(uint best) {
  return best == 0u ? 0u : ~best & 31u;
}

/// A piece of an axis over which the warp is linear.
struct WarpSegment {
  float flat_start;  // lower edges, flat and warped
  float start;
  float slope;       // d warped / d flat
  float half_texel;  // the most that lies between the centre of a texel here and its edge, flat
};

const uint few_segments = 8;
/// What the look-up reads as a uniform buffer, from the same memory as the rest.
struct WarpHeader {
  vec3 flat_from_map[2];  // rows
  vec3 map_from_flat[2];
  uint cells;
  uint resolution;
  uint segment_counts[2];
  float longest_edge;  // of tessellated casters, of the map's width
  uint cut;            // casters are cut where the warp bends, and it does so at edges of texels only; 0: they are bent
  // Of the first segments along u, along v: flat_start, start, slope. Beyond the last one flat_start is out of reach.
  vec3 few[2 * few_segments];
};

/// A warp, followed by segments along u, segments along v (`cells` places each).
struct WarpData {
  WarpHeader header;
  uint first_segments[2 * max_cells];  // of each super-cell: the segment that its lower edge lies in
};

/// What a frame leaves to the next, for temporal blending: importance by metres along both axes.
struct WarpHistory {
  uint orientation[2];    // an axis its own: their groups run at the same time
  float low[2], size[2];  // metres
  float importance[2 * max_cells];
};

/// What the host reads back.
struct WarpFigures {
  float finest[2];       // the greatest share of the map by share of the whole
  float error_ratio[2];  // expected error along the axis, of a uniform map's over the same useful part
  uint orientation;
};

/// The segments of a piece along u and along v, as instance-rate vertex attributes: lower edge flat and warped, slope,
/// upper edge warped.
struct PieceSegments {
  vec4 u, v;
};

/// VisibleInstance::part of a cluster of an instance in segment u along u and v along v: u | v << 16, or `uncut`.
/// The latter for want of room: the vertices are warped, the edges between them straight.
const uint uncut = 0xffffffffu;

/// Bent clusters are drawn by so many commands of so many triangles each: at a tessellation factor of 32 that is about
/// 52,000 vertices, and lavapipe (Mesa 22.3) mixes them up beyond 65,536.
const uint bent_draws_per_cluster = 8, bent_triangles_per_draw = 64;

struct CutConstants {
  uint cluster_count;
  uint first_spare;  // pieces before it: one a visible instance
  uint spare_count;  // for instances that are cut
};

/// What cutting asked for.
struct CutFigures {
  uint pieces;  // of instances that are cut
  uint uncut;   // clusters that did not fit
};

#ifdef __cplusplus
}  // namespace shadewright::shared
#endif
#endif
