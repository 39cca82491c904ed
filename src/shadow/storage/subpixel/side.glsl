// Which sides of bodies a sub-pixel map draws, and the silhouettes among a triangle's edges, from its fold (render/triangle_folds.h).
// Needs a parameterization before it.
#ifndef SHADEWRIGHT_SUBPIXEL_SIDE_GLSL
#define SHADEWRIGHT_SUBPIXEL_SIDE_GLSL

#include "render/octahedral.glsl"
#include "shadow/storage/subpixel/shared.h"

// The light as planes of a mesh meet it: a plane faces it where dot(normal, xyz) > w offset. The adjugate takes the place of the
// inverse, so that neither a mirrored nor a flattened instance is an exception; w is 0 where the light has no position.
vec4 light_from_mesh(vec4 world_from_mesh_rows[3]) {
  vec3 a = world_from_mesh_rows[0].xyz, b = world_from_mesh_rows[1].xyz, c = world_from_mesh_rows[2].xyz;
  vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  if (light_kind() == light_directional) return vec4(-(mat3(bc, ca, ab) * lookup.light_direction), 0.0);
  vec3 origin = vec3(world_from_mesh_rows[0].w, world_from_mesh_rows[1].w, world_from_mesh_rows[2].w);
  return vec4(mat3(bc, ca, ab) * (lookup.light_position - origin), dot(a, bc));
}

bool faces_light(uint normal, float offset, vec4 light) {
  return normal != no_normal && dot(octahedral_direction(unpackSnorm2x16(normal)), light.xyz) > light.w * offset;
}

// Of closed bodies the sides that look away from the light suffice, they cast the same shadow: what enters a closed body leaves it
// again before it meets a receiver outside. They begin where the silhouette is, so that the least depth picks the triangles at the
// silhouette; and lit faces meet no map of themselves.
bool is_left_out(bool facing, uint body) { return (body & body_closed) != 0 && facing != ((body & body_mirrored) != 0); }

// The bits of the edges beyond which the surface does not go on, seen from the light: an open surface's edge, or a fold.
uint silhouette_bits(uvec4 normals, vec4 offsets, vec4 light, bool facing) {
  uint bits = 0;
  for (int e = 0; e < 3; ++e)
    if (normals[e + 1] == open_edge || faces_light(normals[e + 1], offsets[e + 1], light) != facing) bits |= 1u << e;
  return bits;
}

#endif
