// uniform: one matrix a layer. Directional and spot lights have one layer, point lights six: +X -X +Y -Y +Z -Z.
// The parameterization module of a look-up (architecture, section 1).
#include "shadow/map_point.glsl"

#define MAP_CONTIGUOUS 1  // neighbours of a texel are its neighbours in the layer

// The face of a point light's cube that looks along `direction`.
uint uniform_face(vec3 direction) {
  vec3 a = abs(direction);
  if (a.x >= a.y && a.x >= a.z) return direction.x >= 0.0 ? 0 : 1;
  if (a.y >= a.z) return direction.y >= 0.0 ? 2 : 3;
  return direction.z >= 0.0 ? 4 : 5;
}

MapPoint map_point(vec3 world, vec4 plane) {
  uint layer = six_faces ? uniform_face(world - lookup.light_position) : 0;
  return map_project(map_views[layer], layer, world, plane, 1.0 / lookup.map_size);
}

vec3 map_unproject(MapPoint p, vec2 uv, float depth) { return map_unproject_view(map_views[six_faces ? p.layer : 0], uv, depth); }

#include "shadow/parameterization/layered.glsl"
