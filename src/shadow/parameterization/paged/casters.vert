// Corners of (triangle, unit) pairs, in the unit's place in the pool: PAIR_CLIPPED at its borders, or PAIR_SMALL for
// casters.frag, which throws away what lies outside.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer Corners { vec4 corners[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Pairs { uvec3 pairs[]; };

#ifdef PAIR_CLIPPED
out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[4];
};
#endif
#ifdef PAIR_SMALL
layout(location = 0) flat out vec4 unit_texels;  // of the pool: low, high
#endif

void main() {
  uvec3 pair = pairs[gl_VertexIndex / 3];
  vec4 q = corners[3 * pair_triangle(pair) + gl_VertexIndex % 3];
  vec2 place = vec2(slot_place(pair_slot(pair)) * page_texels), first = vec2(pair_page(pair) * page_texels);
  vec2 end = place + (pair_is_block(pair) ? vec2(256.0, 128.0) : vec2(page_texels));
  float pool = 2.0 / float(paged.pool_width * page_texels);
  gl_Position = vec4((q.xy * level_size(pair_level(pair)) + (place - first) * q.w) * pool - q.w, q.zw);
#ifdef PAIR_CLIPPED
  vec2 low = place * pool - 1.0, high = end * pool - 1.0;
  gl_ClipDistance[0] = gl_Position.x - low.x * q.w;
  gl_ClipDistance[1] = high.x * q.w - gl_Position.x;
  gl_ClipDistance[2] = gl_Position.y - low.y * q.w;
  gl_ClipDistance[3] = high.y * q.w - gl_Position.y;
#endif
#ifdef PAIR_SMALL
  unit_texels = vec4(place, end);
#endif
}
