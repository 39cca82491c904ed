// uniform: one matrix a layer. Directional and spot lights have one layer, point lights six: +X -X +Y -Y +Z -Z.
// The parameterization module of a look-up (architecture, section 1).
#include "shadow/map_point.glsl"
#include "shadow/parameterization/cube_face.glsl"

#define MAP_CONTIGUOUS 1  // neighbours of a texel are its neighbours in the layer

void load_map() {}  // views are all it reads

MapPoint map_point(vec3 world, vec4 plane) {
  uint layer = six_faces() ? cube_face(world - lookup.light_position) : 0;
  return map_project(map_view(layer), layer, world, plane, 1.0 / lookup.map_size);
}

vec3 map_unproject(MapPoint p, vec2 uv, float depth) { return map_unproject_view(map_view(p.layer), uv, depth); }

#include "shadow/parameterization/layered.glsl"
