// A triangle of few texels, packed and unpacked (see SmallTriangle).
#ifndef SHADEWRIGHT_SUBPIXEL_SMALL_TRIANGLE_GLSL
#define SHADEWRIGHT_SUBPIXEL_SMALL_TRIANGLE_GLSL

#include "shadow/storage/subpixel/coverage.glsl"
#include "shadow/storage/subpixel/texel.glsl"

// Packs the triangle of three vertices (texels, depth, w) with the silhouettes and the averted bit of `side`; `unit` is the map's
// slope_unit. False if it is not small, or meets the light's own plane.
bool make_small(vec4 a, vec4 b, vec4 c, uint side, SlopeCoding coding, float unit, out SmallTriangle small) {
  float nearest = 1e-5 * max(a.w, max(b.w, c.w));
  a.xy = vertex_step * round(a.xy / vertex_step);
  b.xy = vertex_step * round(b.xy / vertex_step);
  c.xy = vertex_step * round(c.xy / vertex_step);
  vec2 low = min(a.xy, min(b.xy, c.xy)), extent = max(a.xy, max(b.xy, c.xy)) - low, base = floor(low);
  vec2 gradient = depth_gradient(a.xyz, b.xyz, c.xyz);
  small.base = (uint(int(base.x)) & 0xffffu) | (uint(int(base.y)) << 16);
  small.vertices = uint[3](encode_vertex(a.xy - base, side & 1, 0), encode_vertex(b.xy - base, (side >> 1) & 1, 0),
                           encode_vertex(c.xy - base, (side >> 2) & 1, side >> 3));
  small.depths = vec3(a.z, b.z, c.z);
  small.slopes = encode_slope(coding, gradient.x / unit) | (encode_slope(coding, gradient.y / unit) << 16);
  return nearest > 0.0 && min(a.w, min(b.w, c.w)) > nearest && max(extent.x, extent.y) <= small_reach &&
         all(lessThan(abs(base), vec2(32000.0)));
}

#ifdef SMALL_WORDS
// The same by 64-bit words: a CPU device loads each as fast as one of 32.
struct SmallWords {
  uint64_t words[4];
};
SmallTriangle small_from_words(SmallWords w) {
  uvec2 first = unpackUint2x32(w.words[0]), second = unpackUint2x32(w.words[1]), third = unpackUint2x32(w.words[2]),
        fourth = unpackUint2x32(w.words[3]);
  return SmallTriangle(first.x, uint[3](first.y, second.x, second.y), uintBitsToFloat(uvec3(third, fourth.x)), fourth.y);
}

ivec2 small_base(SmallTriangle small) { return ivec2(bitfieldExtract(int(small.base), 0, 16), bitfieldExtract(int(small.base), 16, 16)); }
vec3 small_vertex(SmallTriangle small, uint i, vec2 base) { return vec3(decode_vertex(small.vertices[i]) + base, small.depths[i]); }
#endif

#endif
