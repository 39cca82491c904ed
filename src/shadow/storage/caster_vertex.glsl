// The vertex inputs of what draws casters into a map, and where they put a vertex. Needs a parameterization before it.
#ifdef MAP_CUT
#include "shadow/parameterization/rectilinear/cut_vertex.glsl"

#else
#include "render/scene_vertex.glsl"

vec4 caster_position(uint view) { return map_caster(scene_world_position(), view); }

#endif
