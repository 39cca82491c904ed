// Corners of (triangle, unit) pairs, in the unit's place in the pool: PAIR_CLIPPED at its borders, or PAIR_SMALL for
// page_small.frag, which throws away what lies outside, or PAIR_WHOLE for a geometry stage that does either.
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
#ifdef PAIR_WHOLE
layout(location = 0) flat out uvec3 pair_drawn;
#endif

void main() {
  uvec3 pair = pairs[gl_VertexIndex / 3];
  vec4 q = corners[3 * pair_triangle(pair) + gl_VertexIndex % 3], texels = pair_texels(pair);
  vec2 first = vec2(pair_page(pair) * page_texels);
  float pool = 2.0 / float(paged.pool_width * page_texels);
  gl_Position = vec4((q.xy * level_size(pair_level(pair)) + (texels.xy - first) * q.w) * pool - q.w, q.zw);
#ifdef PAIR_CLIPPED
  vec4 borders = texels * pool - 1.0;
  gl_ClipDistance[0] = gl_Position.x - borders.x * q.w;
  gl_ClipDistance[1] = borders.z * q.w - gl_Position.x;
  gl_ClipDistance[2] = gl_Position.y - borders.y * q.w;
  gl_ClipDistance[3] = borders.w * q.w - gl_Position.y;
#endif
#ifdef PAIR_SMALL
  unit_texels = texels;
#endif
#ifdef PAIR_WHOLE
  pair_drawn = pair;
#endif
}
