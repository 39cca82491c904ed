// The quads over pages and blocks that are drawn anew: they empty their places in the pool.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer Emptied { uint emptied[]; };

void main() {
  uint unit = emptied[gl_VertexIndex / 6], corner = uint[6](0, 1, 2, 2, 1, 3)[gl_VertexIndex % 6];
  vec2 pages = (unit & unit_block) != 0 ? vec2(8.0, 4.0) : vec2(1.0);
  vec2 place = vec2(place_page(unit & (unit_block - 1u))) + pages * vec2(corner & 1, corner >> 1);
  gl_Position = vec4(place * 2.0 / float(paged.pool_width) - 1.0, 1.0, 1.0);
}
