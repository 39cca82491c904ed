// What every parameterization answers for a receiver, and the bias that follows from it (architecture, section 4).
#ifndef SHADEWRIGHT_SHADOW_MAP_POINT_GLSL
#define SHADEWRIGHT_SHADOW_MAP_POINT_GLSL

#include "geometry/position_error.h"
#include "shadow/loads_first.glsl"
#include "shadow/shared.h"

#ifndef SHADEWRIGHT_LOOKUP_SET
#define SHADEWRIGHT_LOOKUP_SET 1
#endif

// The light's kind, or light_any where that is not known when the look-up is compiled: a CPU device runs what each kind asks for
// then. Where it is, lights other than point lights index their one view by a constant too.
layout(constant_id = 0) const uint known_light_kind = light_any;

#ifdef SHADEWRIGHT_LOADS_FIRST  // see loads_first.glsl
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 0, scalar) uniform Lookup {
  LookupData lookup_uniform;
  MapViewData map_views[max_map_views];
};
LookupData lookup;
MapViewData map_first_view;
void load_lookup() {
  lookup = lookup_uniform;
  map_first_view = map_views[0];
}
#else
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 0, scalar) uniform Lookup {
  LookupData lookup;
  MapViewData map_views[max_map_views];
};
#define map_first_view map_views[0]
#endif

uint light_kind() { return known_light_kind == light_any ? lookup.light_kind : known_light_kind; }

// A point light's map has six faces.
bool six_faces() { return light_kind() == light_point; }

// The view of a layer or face. A module with several for each light defines MAP_SEVERAL_VIEWS before this.
MapViewData map_view(uint index) {
#ifdef MAP_SEVERAL_VIEWS
  return map_views[index];
#else
  if (six_faces()) return map_views[index];
  return map_first_view;
#endif
}

struct MapPoint {
  vec2 uv;          // over the layer, v down
  float depth;      // of the receiver at uv, growing away from the light
  uint layer;
  vec2 gradient;    // d depth / d uv of the receiver's plane (of a warped map, no less than it is within a texel)
  vec2 texel;       // a texel's size here, in uv
  float tolerance;  // float error of depth
  bool valid;       // false: nothing is stored for this point, it is lit
  // Where lines are straight and depth is linear: uv itself, unless the map is warped. A module that defines MAP_WARPED tells
  // it of any place of p's layer by map_flat(p, uv), the other way by map_unflat(p, flat_uv).
  vec2 flat_uv;
  vec2 flat_gradient;  // d depth / d flat_uv
};

// A line of the light, world space.
struct Ray {
  vec3 origin;
  vec3 direction;
};

// The depth below which an occluder counts. Within a texel the receiver's own plane comes half a texel's slope closer to the
// light than at uv: so much is its own surface.
float map_threshold(MapPoint p) {
  return p.depth - lookup.bias_scale * (0.5 * dot(abs(p.gradient), p.texel) + p.tolerance);
}

// A receiver at `q`, homogeneous map coordinates whose depth has the coefficients `depth_row` of world x, y, z; `plane` is its
// plane's normal there.
MapPoint map_projected(vec4 q, vec3 plane, vec3 depth_row, uint layer, vec3 world, vec2 texel) {
  vec3 map = q.xyz / q.w;
  float c = abs(plane.z) < 1e-30 ? 1e-30 : plane.z;
  vec2 gradient = -plane.xy / c;

  // A plane that is wrong by e metres is wrong by e / (w |c|) in depth. The depth row itself cancels coordinates too, those of
  // a light with a position included; where a perspective depth is steep that is little, where it is flat it is much. The
  // rest of the arithmetic costs units in the last place of depth and of uv (below 1, times the slope), and the rasterizer
  // snaps vertices to 1/256 texel.
  vec3 a = abs(world) + (light_kind() == light_directional ? vec3(0.0) : abs(lookup.light_position));
  float error_coordinates = position_error_of_coordinates * (a.x + a.y + a.z);
  float error_world = error_coordinates + position_error_of_distance * distance(world, lookup.eye);
  vec2 slope = abs(gradient);
  float ulp = 1.0 / 16777216.0;
  float tolerance = error_world / abs(q.w * c) + error_coordinates * length(depth_row) / abs(q.w) +
                    ulp * (4.0 + 4.0 * (slope.x + slope.y)) + dot(slope, texel) / 256.0;

  bool inside = q.w > 0.0 && all(greaterThanEqual(map.xy, vec2(0.0))) && all(lessThan(map.xy, vec2(1.0)));
  return MapPoint(map.xy, map.z, layer, gradient, texel, tolerance, inside, map.xy, gradient);
}

// Projects a receiver through one view. A plane transforms by the inverse transpose, so its depth gradient is exact for any
// projective map.
MapPoint map_project(MapViewData view, uint layer, vec3 world, vec4 plane, vec2 texel) {
  vec3 depth_row = vec3(view.map_from_world[0].z, view.map_from_world[1].z, view.map_from_world[2].z);
  MapPoint p = map_projected(view.map_from_world * vec4(world, 1.0), (plane * view.world_from_map).xyz, depth_row, layer, world, texel);
  p.valid = p.valid && view.drawn != 0;
  return p;
}

// The world point at a place of one view.
vec3 map_unproject_view(MapViewData view, vec2 uv, float depth) {
  vec4 q = view.world_from_map * vec4(uv, depth, 1.0);
  return q.xyz / q.w;
}

#endif
