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

vec4 map_caster(vec3 world, uint view) {
  vec4 q = map_views[view].map_from_world * vec4(world, 1.0);
  return vec4(2.0 * q.xy - q.w, q.z, q.w);
}

// The texel at p's own plus `offset`; false outside the layer.
bool map_fetch(MapPoint p, ivec2 offset, out ivec3 address) {
  address = ivec3(ivec2(floor(p.uv * lookup.map_size)) + offset, int(p.layer));
  return all(greaterThanEqual(address.xy, ivec2(0))) && all(lessThan(address.xy, ivec2(lookup.map_size)));
}

vec3 map_unproject(MapPoint p, vec2 uv, float depth) { return map_unproject_view(map_views[six_faces ? p.layer : 0], uv, depth); }

Ray map_ray(MapPoint p, vec2 uv) {
  vec3 near = map_unproject(p, uv, 0.0);
  return Ray(near, normalize(map_unproject(p, uv, 1.0) - near));
}
