// A texel of a sub-pixel shadow map, coded and decoded (see texel.h). Places are in texels; depths are the map's.
#ifndef SHADEWRIGHT_SUBPIXEL_TEXEL_GLSL
#define SHADEWRIGHT_SUBPIXEL_TEXEL_GLSL

#include "shadow/storage/subpixel/texel.h"

const float vertex_step = 1.0 / 256.0;
const float vertex_reach = 127.9;  // texels from the centre: what signed 16 bits hold
const float line_reach = 7.99;     // beyond, an edge is out of every look-up's sight
const float line_angle_step = 6.283185307179586 / 65536.0;

// A texel's depth for one texel's way along the light, there: the unit of slopes. Under a perspective light a texel grows with
// the distance and a depth's step with its square, so that the unit is proportional to the homogeneous coordinate.
float slope_unit(MapViewData view, vec2 uv, float depth) {
  mat4 m = view.world_from_map;
  return max(view.slope_unit * abs(dot(vec4(m[0].w, m[1].w, m[2].w, m[3].w), vec4(uv, depth, 1.0))), 1e-30);
}

// Equation 3.
uint encode_slope(SlopeCoding coding, float slope) {
  float middle = 0.5 * float((1 << coding.bits) - 2);
  float t = 0.6366197723675814 * atan(slope);
  return uint(round(middle * (1.0 + sign(t) * pow(abs(t), coding.exponent))));
}

// How far depth may lie from the minimum over a texel, given its decoded slopes.
float depth_reach(SlopeEntry x, SlopeEntry y) { return 0.5 * (abs(x.slope) + x.error + abs(y.slope) + y.error); }

uint encode_vertex(vec2 from_centre) {
  ivec2 v = ivec2(round(from_centre / vertex_step));
  return (uint(v.x) & 0xffffu) | (uint(v.y) << 16);
}
vec2 decode_vertex(uint word) { return vec2(bitfieldExtract(int(word), 0, 16), int(word) >> 16) * vertex_step; }

// The line through an edge, its normal pointing out of the triangle; `spare` are 4 bits more.
uint encode_line(vec2 normal, float distance, uint spare) {
  uint angle = uint(int(round(atan(normal.y, normal.x) / line_angle_step))) & 0xffffu;
  int d = int(round(clamp(distance, -line_reach, line_reach) / vertex_step));
  return angle | ((uint(d) & 0xfffu) << 16) | (spare << 28);
}
vec3 decode_line(uint word) {
  float angle = float(word & 0xffffu) * line_angle_step;
  return vec3(cos(angle), sin(angle), float(bitfieldExtract(int(word), 16, 12)) * vertex_step);
}

#endif
