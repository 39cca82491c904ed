// A triangle of the scene in the stage that draws it conservatively, where one view draws all of a caster.
#include "render/scene_neighbours.glsl"
#include "shadow/storage/caster_geometry.glsl"
#include "shadow/storage/subpixel/side.glsl"

layout(location = 0) in vec4 world[];  // and the bits of the instance's index
layout(push_constant, scalar) uniform Push { uint view; };

#ifdef MAP_CUT
uint caster_part;
#endif

// What the fragments learn of the triangle's side. False if it is not drawn.
bool caster_begin(out uint side) {
  VisibleInstance instance = scene_visible[floatBitsToUint(world[0].w)];
#ifdef MAP_CUT
  caster_part = instance.part;
#endif
  vec3 corners[3] = vec3[3](world[0].xyz, world[1].xyz, world[2].xyz);
  bool facing = faces_light(corners[0], corners[1], corners[2]);
  if (is_left_out(facing, instance.first_triangle)) return false;
  side = (instance.first_triangle & body_closed) != 0 ? triangle_averted : 0;
  uvec3 across = scene_neighbours[(instance.first_triangle & first_triangle_mask) + gl_PrimitiveIDIn];
  for (int e = 0; e < 3; ++e) {
    bool open = across[e] == no_vertex;
    vec3 beyond = open ? vec3(0.0) : scene_vertex_world(instance, across[e]);
    side |= silhouette_bit(e, corners, open, beyond, facing);
  }
  return true;
}

// Where it may be drawn, in texels.
vec4 caster_window() { return vec4(0.0, 0.0, lookup.map_size); }

// Map depth that a texel's width along the light makes.
float caster_slope_unit() { return map_views[view].slope_unit; }

// What goes with a corner of the shape that is drawn, at a place in texels.
void caster_corner(vec2 at) {
#ifdef MAP_CUT
  vec4 distances = map_cut_distances(caster_part, at);
  for (int i = 0; i < 4; ++i) gl_ClipDistance[i] = distances[i];
#endif
}
