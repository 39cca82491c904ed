// A (triangle, unit) pair in a stage that draws it conservatively: what page_bin.comp found out, see storage/subpixel/casters.geom.in.
layout(location = 0) flat in uvec3 pair[];
layout(push_constant, scalar) uniform Push { uint kind; };

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[4];
};
layout(location = 5) flat out vec4 unit_texels;  // of the pool: low, high

bool caster_begin(out uint side) {
  side = pair_side(pair[0]);
  return true;
}

vec4 caster_window() { return pair_texels(pair[0]); }

float caster_slope_unit() { return level_slope_unit(pair_face(pair[0]), pair_level(pair[0])); }

void caster_corner(vec2 at) {
  unit_texels = caster_window();
  vec4 distances = kind == pair_clipped ? vec4(at - unit_texels.xy, unit_texels.zw - at) : vec4(1.0);
  for (int i = 0; i < 4; ++i) gl_ClipDistance[i] = distances[i];
}
