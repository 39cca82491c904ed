// A quad over the place in the pool of each page that is copied from a superpage (RMSM, algorithm 2, step 12).
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer Pages { uint pages[]; };
layout(push_constant, scalar) uniform Push { SuperpagePlace superpage; };
layout(location = 0) flat out ivec2 from_pool;  // from a texel of the pool to the superpage's

void main() {
  uint index = pages[gl_VertexIndex / 6], corner = uint[6](0, 1, 2, 2, 1, 3)[gl_VertexIndex % 6];
  uint number = index - superpage.face * paged.words * 32u - page_base(paged.top - superpage.level);
  uvec2 page = z_curve_place(number) - superpage.first_page, place = place_page(entry_place(page_table[index]));
  from_pool = (ivec2(page) - ivec2(place)) * int(page_texels);
  gl_Position = vec4((vec2(place) + vec2(corner & 1, corner >> 1)) * 2.0 / float(paged.pool_width) - 1.0, 0.0, 1.0);
}
