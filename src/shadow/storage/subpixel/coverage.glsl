// What of a triangle lies in a texel: conservative coverage, and figure 9's consistent minimum depth, which is that of the triangle
// clipped to the texel. The minimum over a convex polygon is at one of its corners: ends of the edges clipped to the texel, or the
// texel's own lowest corner where that is in the triangle.
#ifndef SHADEWRIGHT_SUBPIXEL_COVERAGE_GLSL
#define SHADEWRIGHT_SUBPIXEL_COVERAGE_GLSL

#include "shadow/storage/subpixel/shared.h"

vec2 finite_inverse(vec2 d) { return 1.0 / mix(d, vec2(1e-20), lessThan(abs(d), vec2(1e-20))); }

// The part of the edge from a that lies within the texel around the origin, of its length; none if x > y. `inverse` is that of
// the edge, and `reach` how much of it half a texel is.
vec2 clip_to_texel(vec2 a, vec2 inverse, vec2 reach) {
  vec2 middle = -a * inverse, enter = middle - reach, leave = middle + reach;
  return vec2(max(max(enter.x, enter.y), 0.0), min(min(leave.x, leave.y), 1.0));
}

// The same of the edge from a to b.
vec2 clip_to_texel(vec2 a, vec2 b) {
  vec2 inverse = finite_inverse(b - a);
  return clip_to_texel(a, inverse, half_texel * abs(inverse));
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

// An edge, as far as it is the same in all texels.
struct Edge {
  vec2 along;
  vec2 inverse;  // of that
  vec2 reach;    // how much of the edge half a texel is, along x and y
  float rise;    // of depth
};

Edge edge_between(vec3 a, vec3 b) {
  Edge e;
  e.along = b.xy - a.xy;
  e.inverse = finite_inverse(e.along);
  e.reach = half_texel * abs(e.inverse);
  e.rise = b.z - a.z;
  return e;
}

// Minimum depth along the edge from a within the texel around the origin; infinity where it does not cross.
float edge_minimum(vec3 a, Edge e) {
  vec2 within = clip_to_texel(a.xy, e.inverse, e.reach);
  return within.x <= within.y ? a.z + min(within.x * e.rise, within.y * e.rise) : 1.0 / 0.0;
}

// A triangle, as far as it is the same in all texels.
struct Coverage {
  Edge ab, bc, ca;
  vec2 gradient;  // of its depth
  vec2 lowest;    // corner of a texel
  float descent;  // of its plane's depth from a texel's centre to there
  float nearest;  // of the vertices' depths
};

Coverage coverage_of(vec3 a, vec3 b, vec3 c, vec2 gradient) {
  Coverage t;
  t.ab = edge_between(a, b);
  t.bc = edge_between(b, c);
  t.ca = edge_between(c, a);
  t.gradient = gradient;
  t.lowest = -half_texel * vec2(gradient.x < 0.0 ? -1.0 : 1.0, gradient.y < 0.0 ? -1.0 : 1.0);
  t.descent = half_texel * (abs(gradient.x) + abs(gradient.y));
  t.nearest = min(a.z, min(b.z, c.z));
  return t;
}

// Minimum depth of the triangle within the texel around the origin; infinity where it does not touch it.
// `depth` is that of its plane there.
float consistent_minimum(Coverage t, vec3 a, vec3 b, vec3 c, float depth) {
  float minimum = min(edge_minimum(a, t.ab), min(edge_minimum(b, t.bc), edge_minimum(c, t.ca)));
  vec3 side = vec3(cross2(t.ab.along, t.lowest - a.xy), cross2(t.bc.along, t.lowest - b.xy), cross2(t.ca.along, t.lowest - c.xy));
  bool holds_lowest = min(side.x, min(side.y, side.z)) >= 0.0 || max(side.x, max(side.y, side.z)) <= 0.0;
  return max(holds_lowest ? min(minimum, depth - t.descent) : minimum, t.nearest);
}

#endif
