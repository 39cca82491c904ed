// rectilinear: one view whose image plane is warped along u and along v (Rosen 2012). The parameterization module of a look-up.
#include "shadow/map_point.glsl"
#include "shadow/parameterization/rectilinear/straight.glsl"
#include "shadow/parameterization/rectilinear/shared.h"

#define MAP_CONTIGUOUS 1
#define MAP_WARPED 1  // straight edges bend: see map_flat
#define MAP_CUT 1     // where the warp bends, casters are cut: see cut_vertex.glsl

layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 1, scalar) SHADEWRIGHT_UNIFORM(WarpHeader, warp, load_map)
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 2, scalar) readonly buffer WarpSegments { WarpData warp_data; WarpSegment warp_segments[]; };
// Flat coordinates of texels along u, then v: lower edge, centre, lower edge of the next, ...
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 3, scalar) readonly buffer Flats { float warp_flats[]; };

// The segment that holds a flat coordinate; the end ones go on beyond [0, 1], so that casters there stay where they belong and
// are clipped.
uint warp_segment(uint axis, float x) {
  uint cell = uint(clamp(floor(x * float(warp.cells)), 0.0, float(warp.cells - 1)));
  return warp_data.first_segments[axis * max_cells + cell];
}

// Where it is known when a look-up is compiled that they are all in warp.few: how many segments an axis may have. Else 0.
layout(constant_id = 3) const uint known_segments = 0;

// Takes segment `i` if it holds `x` or begins before it.
void take_segment(uint axis, uint i, float x, inout vec3 few) {
  if (i >= known_segments) return;
  vec3 other = warp.few[axis * few_segments + i];
  few = x >= other.x ? other : few;
}

// To compare a few uniform beginnings instead of looking into the table takes a quarter off a CPU device's look-up. Written out,
// since Mesa 22.3 does not unroll it.
WarpSegment few_segment(uint axis, float x) {
  vec3 few = warp.few[axis * few_segments];
  take_segment(axis, 1, x, few);
  take_segment(axis, 2, x, few);
  take_segment(axis, 3, x, few);
  take_segment(axis, 4, x, few);
  take_segment(axis, 5, x, few);
  take_segment(axis, 6, x, few);
  take_segment(axis, 7, x, few);
  return WarpSegment(few.x, few.y, few.z, 0.0);
}

float warp_axis(uint axis, float x, out WarpSegment s) {
  if (known_segments != 0) s = few_segment(axis, x);
  else s = warp_segments[axis * warp.cells + warp_segment(axis, x)];
  return s.start + s.slope * (x - s.flat_start);
}

float segment_end(uint axis, uint segment) {
  return segment + 1 < warp.segment_counts[axis] ? warp_segments[axis * warp.cells + segment + 1].start : 1.0;
}

vec2 warp_point(vec2 at_flat) {
  WarpSegment s;
  return vec2(warp_axis(0, at_flat.x, s), warp_axis(1, at_flat.y, s));
}

vec2 flat_of_texel_center(ivec2 texel) {
  return vec2(warp_flats[2 * texel.x + 1], warp_flats[2 * (warp.resolution + texel.y) + 2]);
}

vec2 flat_from_map(vec2 map) {
  return vec2(dot(warp.flat_from_map[0], vec3(map, 1.0)), dot(warp.flat_from_map[1], vec3(map, 1.0)));
}

MapPoint map_point(vec3 world, vec4 plane) {
  MapPoint p = map_project(map_first_view, 0, world, plane, vec2(0.0));
  vec2 at_flat = flat_from_map(p.uv);
  WarpSegment u, v;
  vec2 warped = vec2(warp_axis(0, at_flat.x, u), warp_axis(1, at_flat.y, v));
  mat2 map_from_flat = mat2(warp.map_from_flat[0].x, warp.map_from_flat[1].x, warp.map_from_flat[0].y, warp.map_from_flat[1].y);
  p.valid = p.valid && all(greaterThanEqual(at_flat, vec2(0.0))) && all(lessThan(at_flat, vec2(1.0)));
  p.flat_uv = at_flat;
  p.flat_gradient = p.gradient * map_from_flat;
  p.uv = warped;
  p.texel = 1.0 / lookup.map_size;
  // The slope with which the plane may rise over half a texel: that of the largest texel around, in flat coordinates.
  vec2 half_texels = warp.cut != 0 ? 0.5 * p.texel / vec2(u.slope, v.slope) : vec2(u.half_texel, v.half_texel);
  p.gradient = p.flat_gradient * 2.0 * half_texels * lookup.map_size;
  // The rasterizer's snapping, and where casters are not cut what edges may bend and be drawn as straight.
  p.tolerance += dot(abs(p.gradient), p.texel) * (warp.cut != 0 ? snapping_texels : snapping_texels + straight_texels);
  return p;
}

// `p` as all texels would see it whose segments are those of `texel`: what is stored there is linear in these.
MapPoint map_in_frame_of(MapPoint p, ivec2 texel) {
  vec2 center = flat_of_texel_center(texel);
  WarpSegment u, v;
  warp_axis(0, center.x, u);
  warp_axis(1, center.y, v);
  vec2 slope = vec2(u.slope, v.slope);
  p.uv = vec2(u.start, v.start) + slope * (p.flat_uv - vec2(u.flat_start, v.flat_start));
  p.gradient = p.flat_gradient / slope;
  return p;
}

// The texels of a piece of a caster that is cut, as clip distances of a place in texels.
vec4 map_cut_distances(uint part, vec2 at) {
  if (part == uncut) return vec4(1.0);
  uvec2 segment = uvec2(part & 0xffffu, part >> 16);
  vec2 low = vec2(warp_segments[segment.x].start, warp_segments[warp.cells + segment.y].start);
  vec2 high = vec2(segment_end(0, segment.x), segment_end(1, segment.y));
  return vec4(at - low * lookup.map_size, high * lookup.map_size - at).xzyw;
}

// Homogeneous flat coordinates of a caster: (x w, y w, z, w).
vec4 map_caster_flat(vec3 world, uint view) {
  vec4 q = map_views[view].map_from_world * vec4(world, 1.0);
  vec3 h = vec3(q.xy, q.w);
  return vec4(dot(warp.flat_from_map[0], h), dot(warp.flat_from_map[1], h), q.z, q.w);
}

// The clip position of a point whose homogeneous flat coordinates are `p`, in front of the light.
vec4 map_caster_clip(vec4 p) { return vec4((2.0 * warp_point(p.xy / p.w) - 1.0) * p.w, p.zw); }

vec4 map_caster(vec3 world, uint view) { return map_caster_clip(map_caster_flat(world, view)); }

// Flat coordinate of a place of an axis of the map, between the half texels that the table holds.
float unwarp_axis(uint axis, float x) {
  float t = clamp(2.0 * x * float(warp.resolution), 0.0, float(2 * warp.resolution)), k = min(floor(t), float(2 * warp.resolution - 1));
  uint base = axis * (2 * warp.resolution + 1) + uint(k);
  return mix(warp_flats[base], warp_flats[base + 1], t - k);
}

vec2 map_unflat(MapPoint p, vec2 flat_uv) { return warp_point(flat_uv); }

vec2 map_flat(MapPoint p, vec2 uv) { return vec2(unwarp_axis(0, uv.x), unwarp_axis(1, uv.y)); }

vec3 map_unproject(MapPoint p, vec2 uv, float depth) {
  vec3 at_flat = vec3(map_flat(p, uv), 1.0);
  return map_unproject_view(map_first_view, vec2(dot(warp.map_from_flat[0], at_flat), dot(warp.map_from_flat[1], at_flat)), depth);
}

#include "shadow/parameterization/texels.glsl"
