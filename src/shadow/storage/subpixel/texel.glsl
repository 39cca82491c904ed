// A texel of a sub-pixel shadow map, coded and decoded (see texel.h). Places are in texels; depths are the map's.
#ifndef SHADEWRIGHT_SUBPIXEL_TEXEL_GLSL
#define SHADEWRIGHT_SUBPIXEL_TEXEL_GLSL

#include "shadow/storage/subpixel/shared.h"

const float vertex_step = 1.0 / 256.0;
const float vertex_reach = 63.9;  // texels from the centre: what signed 15 bits hold
const float line_reach = 7.99;     // beyond, an edge is out of every look-up's sight

// Equation 3.
uint encode_slope(SlopeCoding coding, float slope) {
  float middle = 0.5 * float((1 << coding.bits) - 2);
  float t = 0.6366197723675814 * atan(slope);
  return uint(round(middle * (1.0 + sign(t) * pow(abs(t), coding.exponent))));
}

// How far depth may lie from the minimum over a texel, given its decoded slopes.
float depth_reach(SlopeEntry x, SlopeEntry y) { return 0.5 * (abs(x.slope) + x.error + abs(y.slope) + y.error); }

// A vertex; whether the edge to the next one is a silhouette; and a bit more.
uint encode_vertex(vec2 from_centre, uint silhouette, uint spare) {
  ivec2 v = ivec2(from_centre / vertex_step);  // whole already
  return (uint(v.x) & 0x7fffu) | (silhouette << 15) | ((uint(v.y) & 0x7fffu) << 16) | (spare << 31);
}
vec2 decode_vertex(uint word) {
  return vec2(bitfieldExtract(int(word), 0, 15), bitfieldExtract(int(word), 16, 15)) * vertex_step;
}

// Depth at the texel's centre, from the minimum over the texel; `within` is how far it may lie from that.
uint encode_depth(bool absolute, float depth, float minimum, float within) {
  return absolute ? uint(round(65535.0 * clamp(depth, 0.0, 1.0))) : uint(round(511.0 * clamp((depth - minimum) / within, -1.0, 1.0) + 511.0));
}

// The last word.
uint encode_slopes(uint bits, uint code_x, uint code_y, uint depth_code) {
  return (code_x << (32 - bits)) | (code_y << (32 - 2 * bits)) | depth_code;
}

// The line through an edge: its normal out of the triangle, of any length, as an angle; whether it is a silhouette; and 4 bits more.
// The angle is measured around a square, not a circle, which needs no trigonometry: x falls from 1 to -1 in the upper half and
// rises in the lower.
uint encode_angle(vec2 normal) {
  float x = normal.x / (abs(normal.x) + abs(normal.y));
  return uint(int(round((normal.y < 0.0 ? x - 1.0 : 1.0 - x) * 8192.0))) & 0x7fffu;
}
uint encode_line(uint angle, float distance, uint silhouette, uint spare) {
  int d = int(round(clamp(distance, -line_reach, line_reach) / vertex_step));
  return angle | (silhouette << 15) | ((uint(d) & 0xfffu) << 16) | (spare << 28);
}
vec3 decode_line(uint word) {
  float angle = float(bitfieldExtract(int(word), 0, 15)) / 8192.0;
  float x = 1.0 - abs(angle), y = (1.0 - abs(x)) * (angle < 0.0 ? -1.0 : 1.0);
  return vec3(normalize(vec2(x, y)), float(bitfieldExtract(int(word), 16, 12)) * vertex_step);
}

// Of vertices and lines alike.
bool decode_silhouette(uint word) { return (word & 0x8000u) != 0; }

#endif
