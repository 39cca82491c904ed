// Which sides of bodies a sub-pixel map draws, and the silhouettes among a triangle's edges. Needs a parameterization before it.
#ifndef SHADEWRIGHT_SUBPIXEL_SIDE_GLSL
#define SHADEWRIGHT_SUBPIXEL_SIDE_GLSL

#include "shadow/storage/subpixel/shared.h"

// Whether the light is before the triangle's plane.
bool faces_light(vec3 a, vec3 b, vec3 c) {
  vec3 to_light = lookup.light_kind == light_directional ? -lookup.light_direction : lookup.light_position - a;
  return dot(cross(b - a, c - a), to_light) > 0.0;
}

// Of closed bodies the sides that look away from the light suffice, they cast the same shadow: what enters a closed body leaves it
// again before it meets a receiver outside. They begin where the silhouette is, so that the least depth picks the triangles at the
// silhouette; and lit faces meet no map of themselves.
bool is_left_out(bool facing, uint body) { return (body & body_closed) != 0 && facing != ((body & body_mirrored) != 0); }

// The bit of edge `e` if the surface does not go on beyond it, seen from the light: an open surface's edge, or a fold. `across` is the
// third corner of the triangle beyond, if there is one.
uint silhouette_bit(int e, vec3 world[3], bool open, vec3 across, bool facing) {
  return open || faces_light(world[(e + 1) % 3], world[e], across) != facing ? 1u << e : 0u;
}

#endif
