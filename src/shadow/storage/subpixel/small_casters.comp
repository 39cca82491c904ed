// Rasterizes a view's small triangles (see small_casters.h): of each texel, the triangle of the least minimum depth, of the
// first of those of the same. One subgroup a place in the list of visible instances.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_atomic_int64 : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#include "shadow/map_point.glsl"
#define SMALL_WORDS
#include "shadow/storage/subpixel/small_triangle.glsl"

layout(local_size_x = 32) in;
layout(set = 0, binding = 0, scalar) readonly buffer SmallTriangles { SmallWords small_triangles[]; };
layout(set = 0, binding = 1, scalar) readonly buffer SmallLists { SmallList small_lists[]; };
layout(set = 0, binding = 2, scalar) buffer Kept { uint64_t kept[]; };  // minimum depth, and the triangle's place
layout(set = 0, binding = 3, scalar) volatile readonly buffer KeptDepths { uvec2 kept_depths[]; };  // the same, in y
layout(set = 0, binding = 4, scalar) writeonly buffer Tiles { uint marked[]; };
layout(push_constant, scalar) uniform Push { uint list_capacity; };

struct Triangle {
  vec3 a, b, c;
  Coverage coverage;
  ivec2 first, last;  // of the texels that may be touched
};

Triangle load(uint place, ivec2 size) {
  SmallTriangle small = small_from_words(small_triangles[place]);
  vec2 base = vec2(small_base(small));
  Triangle t;
  t.a = small_vertex(small, 0, base);
  t.b = small_vertex(small, 1, base);
  t.c = small_vertex(small, 2, base);
  t.coverage = coverage_of(t.a, t.b, t.c, depth_gradient(t.a, t.b, t.c));
  t.first = max(ivec2(ceil(min(t.a.xy, min(t.b.xy, t.c.xy)) - half_texel - 0.5)), ivec2(0));
  t.last = min(ivec2(floor(max(t.a.xy, max(t.b.xy, t.c.xy)) + half_texel - 0.5)), size - 1);
  return t;
}

void keep(Triangle t, uint place, ivec2 at, int row) {
  vec3 centre = vec3(vec2(at) + 0.5, 0.0);
  vec3 a = t.a - centre, b = t.b - centre, c = t.c - centre;
  float minimum = consistent_minimum(t.coverage, a, b, c, a.z - dot(t.coverage.gradient, a.xy));
  uint depth = floatBitsToUint(abs(clamp(minimum, 0.0, 1.0))), at_row = at.y * row + at.x;
  if (!isinf(minimum) && depth <= kept_depths[at_row].y)  // read first, as an atomic access costs more
    atomicMin(kept[at_row], (uint64_t(depth) << 32) | place);
}

uint tile_at(ivec2 at, int row) { return uint(at.y / int(small_tile) * ((row + int(small_tile) - 1) / int(small_tile)) + at.x / int(small_tile)); }

// Each invocation one triangle.
void rasterize(uint place, ivec2 size) {
  Triangle t = load(place, size);
  if (any(greaterThan(t.first, t.last))) return;
  marked[tile_at(t.first, size.x)] = 1;
  marked[tile_at(ivec2(t.last.x, t.first.y), size.x)] = 1;
  marked[tile_at(ivec2(t.first.x, t.last.y), size.x)] = 1;
  marked[tile_at(t.last, size.x)] = 1;
  for (ivec2 at = t.first; at.y <= t.last.y;) {
    keep(t, place, at, size.x);
    bool ended = at.x == t.last.x;
    at = ivec2(ended ? t.first.x : at.x + 1, at.y + int(ended));
  }
}

void main() {
  ivec2 size = ivec2(lookup.map_size);
  for (uint place = gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID; place < list_capacity;
       place += gl_NumWorkGroups.x * gl_NumSubgroups)
    for (uint t = small_lists[place].begin + gl_SubgroupInvocationID; t < small_lists[place].end; t += gl_SubgroupSize) rasterize(t, size);
}
