// Cuts each cluster's visible instances into pieces, one for each pair of segments that its box touches; those outside of the map are
// dropped. A cluster of which nothing is cut keeps its place in the list, others take theirs from a common store. One invocation a
// cluster.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/rectilinear/rectilinear.glsl"
#include "shadow/parameterization/rectilinear/cluster_bounds.glsl"
#include "shadow/parameterization/rectilinear/shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Clusters { ClusterData clusters[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Draws { DrawCommand draws[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Visible { VisibleInstance visible[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer CutDraws { DrawCommand cut_draws[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Pieces { VisibleInstance pieces[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer UncutDraws { DrawCommand uncut_draws[]; };
layout(set = 0, binding = 7, scalar) buffer Figures { CutFigures figures; };
layout(set = 0, binding = 8, scalar) writeonly buffer PieceWarps { PieceSegments piece_segments[]; };
layout(push_constant, scalar) uniform Push { CutConstants constants; };

struct Segments {
  uvec2 first, last;
  uint count;  // of pairs
};

vec4 piece_segment(uint axis, uint i) {
  WarpSegment s = warp_segments[axis * warp.cells + i];
  return vec4(s.flat_start, s.start, s.slope, segment_end(axis, i));
}

// Those that the box touches.
Segments segments_of(VisibleInstance instance, ClusterData cluster) {
  FlatBounds bounds = flat_bounds(instance, cluster);
  Segments s = Segments(uvec2(0), uvec2(warp.segment_counts[0], warp.segment_counts[1]) - 1, 0);
  if (bounds.in_front) {
    if (any(greaterThan(bounds.low, vec2(1.0))) || any(lessThan(bounds.high, vec2(0.0)))) return s;
    for (uint axis = 0; axis < 2; ++axis) {
      s.first[axis] = warp_segment(axis, bounds.low[axis]);
      s.last[axis] = warp_segment(axis, bounds.high[axis]);
    }
  }
  uvec2 size = s.last - s.first + 1;
  s.count = size.x * size.y;
  return s;
}

void main() {
  uint slot = gl_GlobalInvocationID.x;
  if (slot >= constants.cluster_count) return;
  DrawCommand all = draws[slot];
  ClusterData cluster = clusters[order[slot]];
  uint count = 0;
  bool cut = false;
  for (uint i = 0; i < all.instance_count; ++i) {
    uint touched = segments_of(visible[all.first_instance + i], cluster).count;
    cut = cut || touched > 1;
    count += touched;
  }
  uint base = all.first_instance;
  if (cut) {
    uint spare = atomicAdd(figures.pieces, count);
    cut = spare + count <= constants.spare_count;
    if (cut) base = constants.first_spare + spare;
    else atomicAdd(figures.uncut, 1);
  }
  // Cut ones fill the place in the list from the front; those for which there is no room theirs from the end.
  uint piece = base, uncut_begin = all.first_instance + all.instance_count;
  for (uint i = 0; i < all.instance_count; ++i) {
    VisibleInstance instance = visible[all.first_instance + i];
    Segments s = segments_of(instance, cluster);
    if (s.count > 1 && !cut) {
      instance.part = uncut;
      pieces[--uncut_begin] = instance;
      continue;
    }
    uint width = s.last.x - s.first.x + 1;
    for (uint k = 0; k < s.count; ++k) {
      uint u = s.first.x + k % width, v = s.first.y + k / width;
      instance.part = u | (v << 16);
      piece_segments[piece] = PieceSegments(piece_segment(0, u), piece_segment(1, v));
      pieces[piece++] = instance;
    }
  }
  cut_draws[slot] = DrawCommand(all.index_count, piece - base, all.first_index, 0, base);
  uncut_draws[slot] = DrawCommand(all.index_count, all.first_instance + all.instance_count - uncut_begin, all.first_index, 0, uncut_begin);
}
