// A texel of a sub-pixel map that small_casters.comp has found: the same bits as casters.frag makes of the triangle.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/map_point.glsl"
#define SMALL_WORDS
#include "shadow/storage/subpixel/small_triangle.glsl"

layout(set = 0, binding = 1, scalar) readonly buffer SmallTriangles { SmallWords small_triangles[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Kept { uint64_t kept[]; };  // the triangle's place, and minimum depth
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 10, scalar) uniform SlopeTable { SubpixelSlopes table; };
layout(push_constant, scalar) uniform Push { uint view; };
layout(location = 0) out uvec4 texel;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  uvec2 key = unpackUint2x32(kept[at.y * int(lookup.map_size.x) + at.x]);
  if (key.x == 0xffffffffu) discard;
  float minimum = uintBitsToFloat(key.y);
  gl_FragDepth = minimum;

  SmallTriangle small = small_from_words(small_triangles[key.x]);
  vec2 from_centre = vec2(small_base(small) - at) - 0.5;
  vec3 a = small_vertex(small, 0, from_centre), b = small_vertex(small, 1, from_centre), c = small_vertex(small, 2, from_centre);
  SlopeCoding coding = lookup.slope_coding;
  uint code_x = small.slopes & 0xffffu, code_y = small.slopes >> 16;
  float within = map_views[view].slope_unit * depth_reach(table.slopes[code_x], table.slopes[code_y]);
  texel.rgb = uvec3(encode_vertex(a.xy, (small.vertices[0] >> 15) & 1, 0), encode_vertex(b.xy, (small.vertices[1] >> 15) & 1, 0),
                    encode_vertex(c.xy, (small.vertices[2] >> 15) & 1, small.vertices[2] >> 31));
  uint depth_code = encode_depth(coding.absolute_depth != 0, a.z - dot(depth_gradient(a, b, c), a.xy), minimum, within);
  texel.a = encode_slopes(coding.bits, code_x, code_y, depth_code);
}
