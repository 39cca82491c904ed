// What of a triangle lies in a texel: conservative coverage, and figure 9's consistent minimum depth, which is that of the triangle
// clipped to the texel. The minimum over a convex polygon is at one of its corners: ends of the edges clipped to the texel, or the
// texel's own lowest corner where that is in the triangle.
#ifndef SHADEWRIGHT_SUBPIXEL_COVERAGE_GLSL
#define SHADEWRIGHT_SUBPIXEL_COVERAGE_GLSL

#include "shadow/storage/subpixel/shared.h"

// The part of the edge from a to b that lies within the texel around the origin, of its length; none if x > y.
vec2 clip_to_texel(vec2 a, vec2 b) {
  vec2 d = b - a;
  vec2 inverse = 1.0 / mix(d, vec2(1e-20), lessThan(abs(d), vec2(1e-20)));
  vec2 middle = -a * inverse, reach = half_texel * abs(inverse), enter = middle - reach, leave = middle + reach;
  return vec2(max(max(enter.x, enter.y), 0.0), min(min(leave.x, leave.y), 1.0));
}

// Minimum depth along the edge from a to b within the texel around the origin; infinity where it does not cross.
float edge_minimum(vec3 a, vec3 b) {
  vec2 within = clip_to_texel(a.xy, b.xy);
  return within.x <= within.y ? min(mix(a.z, b.z, within.x), mix(a.z, b.z, within.y)) : 1.0 / 0.0;
}

// Twice the signed area.
float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

bool in_triangle(vec2 p, vec2 a, vec2 b, vec2 c) {
  vec3 side = vec3(cross2(b - a, p - a), cross2(c - b, p - b), cross2(a - c, p - c));
  return all(greaterThanEqual(side, vec3(0.0))) || all(lessThanEqual(side, vec3(0.0)));
}

// The gradient of the triangle's depth. A triangle seen edge-on has none; 0 then.
vec2 depth_gradient(vec3 a, vec3 b, vec3 c) {
  vec3 u = b - a, v = c - a;
  float area = cross2(u.xy, v.xy);
  return area == 0.0 ? vec2(0.0) : vec2(u.z * v.y - v.z * u.y, v.z * u.x - u.z * v.x) / area;
}

// Minimum depth of the triangle within the texel around the origin; infinity where it does not touch it.
// `depth` is that of its plane there.
float consistent_minimum(vec3 a, vec3 b, vec3 c, vec2 gradient, float depth) {
  float lowest = depth - half_texel * (abs(gradient.x) + abs(gradient.y));
  vec2 ab = b.xy - a.xy, bc = c.xy - b.xy, ca = a.xy - c.xy;
  float turn = cross2(ab, bc) < 0.0 ? -1.0 : 1.0;
  vec3 side = turn * vec3(cross2(a.xy, ab), cross2(b.xy, bc), cross2(c.xy, ca));
  vec3 reach = half_texel * vec3(abs(ab.x) + abs(ab.y), abs(bc.x) + abs(bc.y), abs(ca.x) + abs(ca.y));
  if (all(greaterThan(side, reach))) return max(lowest, min(a.z, min(b.z, c.z)));  // the texel lies within
  float minimum = min(edge_minimum(a, b), min(edge_minimum(b, c), edge_minimum(c, a)));
  vec2 corner = -half_texel * vec2(gradient.x < 0.0 ? -1.0 : 1.0, gradient.y < 0.0 ? -1.0 : 1.0);
  if (in_triangle(corner, a.xy, b.xy, c.xy)) minimum = min(minimum, lowest);
  return max(minimum, min(a.z, min(b.z, c.z)));
}

#endif
