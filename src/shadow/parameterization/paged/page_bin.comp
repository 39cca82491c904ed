// Cuts the scene into (triangle, unit) pairs: for each triangle of a touched cluster, every page to draw, or whole block of them,
// in which it may cover a texel's centre, or come as near to one as constants.reach. A cluster whose pairs do not fit waits for the
// next round; what it has drawn already is then drawn twice, which changes nothing. PAIR_SIDES: pairs tell the triangle's side and its
// silhouettes, as sub-pixel maps need them.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"
#ifdef PAIR_SIDES
#include "shadow/storage/subpixel/side.glsl"
#endif

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Clusters { ClusterData clusters[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Instances { InstanceData instances[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Draw { uint draw[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Touched { PageCluster touched[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer Late { PageCluster late[]; };
layout(set = 0, binding = 7, scalar) buffer StateOut { PageState state; };
layout(set = 0, binding = 8, scalar) writeonly buffer Pairs { uvec3 pairs[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer Corners { vec4 corners[]; };  // in the map, homogeneous
#ifdef PAIR_SIDES
layout(set = 0, binding = 10, scalar) readonly buffer FoldNormals { uvec4 fold_normals[]; };
layout(set = 0, binding = 11, scalar) readonly buffer FoldOffsets { vec4 fold_offsets[]; };
#endif
layout(push_constant, scalar) uniform Push { BinConstants constants; };

shared uint overflow;

const float few_texels = 512.0;

// A triangle in the map. Its edges are homogeneous functions of a place relative to `origin`, positive inside: for places near it
// floats are fine, and a triangle that reaches behind a lamp is what it is in front.
struct MapTriangle {
  vec2 origin;
  vec3 edges[3];
  vec2 low, high;  // bounds
  bool in_front;   // all of it
  float area;      // if so
};

bool map_triangle(vec4 q[3], float near, out MapTriangle t) {
  bvec3 behind = lessThan(vec3(q[0].w, q[1].w, q[2].w), vec3(near));
  if (all(behind)) return false;
  t.in_front = !any(behind);
  t.origin = t.in_front ? q[0].xy / q[0].w : vec2(0.5);
  t.low = vec2(0.0);
  t.high = vec2(1.0);
  if (t.in_front) {
    vec2 b = q[1].xy / q[1].w, c = q[2].xy / q[2].w;
    t.low = min(t.origin, min(b, c));
    t.high = max(t.origin, max(b, c));
  }
  vec3 h[3];
  for (int k = 0; k < 3; ++k) h[k] = vec3(q[k].xy - t.origin * q[k].w, q[k].w);
  for (int k = 0; k < 3; ++k) t.edges[k] = cross(h[(k + 1) % 3], h[(k + 2) % 3]);
  float area = dot(h[0], t.edges[0]);
  t.area = 0.5 * abs(area) / (q[0].w * q[1].w * q[2].w);
  if (area < 0.0)
    for (int k = 0; k < 3; ++k) t.edges[k] = -t.edges[k];
  return true;
}

// Whether it may cover a place of a box, of which the rasterizer may be off by `slack`.
bool covers(MapTriangle t, vec2 middle, vec2 reach, float slack) {
  vec2 p = middle - t.origin;
  for (int k = 0; k < 3; ++k)
    if (dot(t.edges[k].xy, p) + t.edges[k].z + dot(abs(t.edges[k].xy), reach + slack) < 0.0) return false;
  return true;
}

// Walks levels, blocks and units in one loop: nested ones would let a device's lanes wait for each other at each end.
void bin(MapTriangle t, uint triangle, uint side, PageCluster part) {
  uint levels = part.levels, level = 0, word = 0, bits = 0;
  float size = 1.0, slack = 0.0;
  vec2 first, last;                                   // the texels whose centres the bounds hold
  ivec2 block = ivec2(0), block_a = ivec2(0), block_b = ivec2(-1), page_a, page_b;
  bool whole = false;
  while (true) {
    if (bits == 0) {
      if (++block.x > block_b.x) block = ivec2(block_a.x, block.y + 1);
      if (block.y > block_b.y) {
        if (levels == 0) break;
        level = uint(findLSB(levels));
        levels &= levels - 1;
        size = level_size(level);
        slack = constants.reach + 1.0 / 64.0 + size * 3e-7;  // the rasterizer snaps to 1/256, and float has its error
        first = clamp(ceil(t.low * size - 0.5 - slack), vec2(0.0), vec2(size));
        last = clamp(floor(t.high * size - 0.5 + slack), vec2(-1.0), vec2(size - 1.0));
        bool empty = any(greaterThan(first, last));
        page_a = ivec2(first) / int(page_texels);
        page_b = ivec2(last) / int(page_texels);
        block_a = page_a / ivec2(8, 4);  // small levels have less than a block
        block_b = empty ? ivec2(-1) : page_b / ivec2(8, 4);
        block = empty ? ivec2(0) : block_a;
        if (empty) continue;
      }
      ivec2 corner = block * ivec2(8, 4);
      word = page_index(part.face, level, uvec2(corner)) >> 5;
      uint drawn = draw[word];
      bits = drawn & block_mask(max(page_a - corner, ivec2(0)), min(page_b - corner, ivec2(7, 3)));
      whole = drawn == ~0u && (page_table[word * 32u] & entry_block) != 0;
      if (whole) bits = min(bits, 1u);
      if (bits == 0) continue;
    }
    uint bit = uint(findLSB(bits));
    bits &= bits - 1;
    uvec2 page = uvec2(block) * uvec2(8, 4) + z_curve_place(bit);
    vec2 from = vec2(page * page_texels), to = from + (whole ? vec2(255.0, 127.0) : vec2(31.0));
    vec2 a = max(first, from), b = min(last, to);
    if (!covers(t, (0.5 * (a + b) + 0.5) / size, 0.5 * (b - a) / size, slack / size)) continue;
    // What covers no texel's centre outside need not be cut.
    float room = 0.49 - constants.reach;
    bool inner = t.in_front && all(greaterThan(t.low * size, from - room)) && all(lessThan(t.high * size, to + 1.0 + room));
    uint kind = inner ? pair_inner : t.in_front && t.area * size * size < few_texels ? pair_small : pair_clipped;
    uint pair = constants.first_pair[kind] + atomicAdd(state.draws[kind].vertex_count, 3) / 3;
    if (pair >= constants.first_pair[kind + 1]) {
      overflow = 1;
      continue;
    }
    pairs[pair] = pack_pair(triangle, side, part.face, level, page, entry_place(page_table[word * 32u + bit]), whole);
  }
}

#ifndef PAIR_SIDES
// Closed bodies show a sun only their facing sides: the others lie behind them on every ray.
bool averted(vec3 a, vec3 b, vec3 c, float turn) { return turn * dot(cross(b - a, c - a), lookup.light_direction) > 0.0; }
#endif

void main() {
  if (gl_LocalInvocationIndex == 0) overflow = 0;
  barrier();
  uint place = gl_WorkGroupID.y * 32768u + gl_WorkGroupID.x;
  bool works = place < min(state.visible_clusters, constants.cluster_capacity);
  PageCluster part;
  ClusterData cluster;
  bool fits = false;
  if (works) {
    part = touched[place];
    cluster = clusters[part.cluster];
    fits = part.first_triangle + cluster.index_count / 3 <= constants.triangle_capacity;
  }
  if (fits) {
    mat4 map_from_world = map_views[part.face].map_from_world;
    mat4x3 world_from_mesh = instances[part.instance].world_from_mesh;
    float near = paged.near[part.face];
    bool mirrored = determinant(mat3(world_from_mesh)) < 0.0, closed = (cluster.body & body_closed) != 0;
#ifdef PAIR_SIDES
    mat3x4 rows = transpose(world_from_mesh);
    vec4 light = light_from_mesh(vec4[3](rows[0], rows[1], rows[2]));
#endif
    for (uint t = gl_LocalInvocationIndex; t < cluster.index_count / 3; t += 64) {
      uint first_index = cluster.first_index + 3 * t;
      vec3 world[3];
      vec4 q[3];
      for (int k = 0; k < 3; ++k) {
        world[k] = world_from_mesh * vec4(positions[indices[first_index + k]], 1.0);
        q[k] = map_from_world * vec4(world[k], 1.0);
      }
      MapTriangle triangle;
#ifdef PAIR_SIDES
      uvec4 normals = fold_normals[first_index / 3];
      vec4 offsets = fold_offsets[first_index / 3];
      bool facing = faces_light(normals.x, offsets.x, light);
      if (is_left_out(facing, cluster.body | (mirrored ? body_mirrored : 0))) continue;
      uint side = silhouette_bits(normals, offsets, light, facing) | (closed ? triangle_averted : 0);
#else
      const uint side = 0;
      if (closed && light_kind() == light_directional && averted(world[0], world[1], world[2], mirrored ? -1.0 : 1.0)) continue;
#endif
      if (!map_triangle(q, near, triangle)) continue;
      for (int k = 0; k < 3; ++k) corners[3 * (part.first_triangle + t) + k] = q[k];
      bin(triangle, part.first_triangle + t, side, part);
    }
  }
  barrier();
  if (!works || gl_LocalInvocationIndex > 0 || (fits && overflow == 0)) return;
  part.first_triangle = atomicAdd(state.late_triangles, cluster.index_count / 3);
  late[atomicAdd(state.late_clusters, 1)] = part;
}
