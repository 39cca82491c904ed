// The vertex inputs of what draws casters into a map (see CasterDraws::describe), and where they put a vertex. Needs a
// parameterization before it.
#ifdef MAP_PREPARED_CASTERS

// Corners of (triangle, page) pairs: cut off at the borders of the page's place in the pool.
layout(location = 0) in vec3 corner_position;
layout(location = 1) in uint corner_slot;

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[4];
};

vec4 caster_position(uint view) {
  float page = 2.0 / float(paged.pool_width);
  vec2 low = vec2(corner_slot % paged.pool_width, corner_slot / paged.pool_width) * page - 1.0;
  gl_ClipDistance[0] = corner_position.x - low.x;
  gl_ClipDistance[1] = low.x + page - corner_position.x;
  gl_ClipDistance[2] = corner_position.y - low.y;
  gl_ClipDistance[3] = low.y + page - corner_position.y;
  return vec4(corner_position, 1.0);
}

#elif defined(MAP_CUT)
#include "shadow/parameterization/rectilinear/cut_vertex.glsl"

#else
#include "render/scene_vertex.glsl"

vec4 caster_position(uint view) { return map_caster(scene_world_position(), view); }

#endif
