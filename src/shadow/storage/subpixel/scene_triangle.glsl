// A triangle of the scene in the stage that draws it conservatively, where one view draws all of a caster. Its side is found before, see
// caster_sides.comp.
#include "render/shared.h"
#include "shadow/storage/caster_geometry.glsl"
#include "shadow/storage/subpixel/shared.h"

layout(set = 0, binding = 0, scalar) readonly buffer CasterSides { uint caster_sides[]; };
layout(set = 0, binding = 1, scalar) readonly buffer SceneVisible { VisibleInstance scene_visible[]; };
layout(location = 0) flat in uint instance_index[];
layout(push_constant, scalar) uniform Push { uint view; };

#ifdef MAP_CUT
uint caster_part;
#endif

// What the fragments learn of the triangle's side. False if it is not drawn.
bool caster_begin(out uint side) {
  VisibleInstance instance = scene_visible[instance_index[0]];
#ifdef MAP_CUT
  caster_part = instance.part;
#endif
  uint at = instance.first_listed + gl_PrimitiveIDIn;  // which counts within a draw
  uint bits = bitfieldExtract(caster_sides[at / sides_per_word], int(32 / sides_per_word * (at % sides_per_word)), 32 / int(sides_per_word));
  side = (bits & (side_drawn - 1)) | ((instance.first_triangle & body_closed) != 0 ? triangle_averted : 0);
  return (bits & side_drawn) != 0;
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
