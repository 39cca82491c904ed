// As the paper draws: parts each cluster's visible instances into those whose triangles stay straight in the warped map, of which just
// the vertices are warped, and those that bend, which are tessellated and drawn by bent.geom; those outside of the useful part are
// dropped. One invocation a cluster.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/rectilinear/rectilinear.glsl"
#include "shadow/parameterization/rectilinear/cluster_bounds.glsl"
#include "shadow/parameterization/rectilinear/shared.h"
#include "shadow/parameterization/rectilinear/straight.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Clusters { ClusterData clusters[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Draws { DrawCommand draws[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Visible { VisibleInstance visible[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer StraightDraws { DrawCommand straight_draws[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Pieces { VisibleInstance pieces[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer BentDraws { DrawCommand bent_draws[]; };
layout(push_constant, scalar) uniform Push { CutConstants constants; };

const uint dropped = 0, straight = 1, bent = 2;

// How far, in texels, the warp of an axis may leave the chord over `size` within [low, high], all flat. Over an interval a piecewise
// linear function with slopes in a range leaves its chord by at most a quarter of interval times range.
float bend(uint axis, float low, float high, float size) {
  float n = float(warp.cells);
  uint first = uint(clamp(floor(low * n), 0.0, n - 1.0)), last = uint(clamp(floor(high * n), 0.0, n - 1.0));
  if (first == last) return 0.0;
  float greatest = 0.0, smallest_share = 1.0, greatest_share = 0.0, before = warp_segments[axis * warp.cells + first].slope / n;
  for (uint k = first; k <= last; ++k) {
    float share = warp_segments[axis * warp.cells + k].slope / n;
    greatest = max(greatest, abs(share - before));
    smallest_share = min(smallest_share, share);
    greatest_share = max(greatest_share, share);
    before = share;
  }
  float range = min(greatest_share - smallest_share, greatest * (floor(size * n) + 1.0));
  return 0.25 * size * range * n * float(warp.resolution);
}

uint kind_of(VisibleInstance instance, ClusterData cluster) {
  FlatBounds bounds = flat_bounds(instance, cluster);
  vec2 low = bounds.low, high = bounds.high;
  if (!bounds.in_front) return bent;
  if (any(greaterThan(low, vec2(1.0))) || any(lessThan(high, vec2(0.0)))) return dropped;
  vec2 edge = high - low;
  if (light_kind() == light_directional) {
    // The largest stretch of the instance: of a matrix of rotation and scale exact, else no less.
    mat3 linear = mat3(instance.world_from_mesh_rows[0].xyz, instance.world_from_mesh_rows[1].xyz, instance.world_from_mesh_rows[2].xyz);  // transposed
    mat3 squared = linear * transpose(linear);
    vec3 sums = abs(squared[0]) + abs(squared[1]) + abs(squared[2]);
    float longest = cluster.longest_edge * sqrt(max(sums.x, max(sums.y, sums.z)));
    mat4 m = map_views[0].map_from_world;
    for (int axis = 0; axis < 2; ++axis) {
      vec2 row = warp.flat_from_map[axis].xy;
      edge[axis] = min(edge[axis], longest * length(row.x * vec3(m[0].x, m[1].x, m[2].x) + row.y * vec3(m[0].y, m[1].y, m[2].y)));
    }
  }
  return bend(0, low.x, high.x, edge.x) + bend(1, low.y, high.y, edge.y) > straight_texels ? bent : straight;
}

void main() {
  uint slot = gl_GlobalInvocationID.x;
  if (slot >= constants.cluster_count) return;
  DrawCommand all = draws[slot];
  ClusterData cluster = clusters[order[slot]];
  // Straight ones fill the cluster's place in the list from the front, bent ones from the end.
  uint first = all.first_instance, straight_end = first, bent_begin = first + all.instance_count;
  for (uint i = 0; i < all.instance_count; ++i) {
    VisibleInstance instance = visible[first + i];
    uint kind = kind_of(instance, cluster);
    instance.part = uncut;
    if (kind == straight) pieces[straight_end++] = instance;
    else if (kind == bent) pieces[--bent_begin] = instance;
  }
  straight_draws[slot] = DrawCommand(all.index_count, straight_end - first, all.first_index, 0, first);
  for (uint i = 0; i < bent_draws_per_cluster; ++i) {
    uint skipped = min(3 * i * bent_triangles_per_draw, all.index_count);
    bent_draws[slot * bent_draws_per_cluster + i] =
        DrawCommand(min(all.index_count - skipped, 3 * bent_triangles_per_draw), first + all.instance_count - bent_begin,
                    all.first_index + skipped, 0, bent_begin);
  }
}
