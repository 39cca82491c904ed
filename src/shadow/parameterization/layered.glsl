// What parameterizations share whose views fill a layer each through one matrix. Needs their map_unproject before it.

vec4 map_caster(vec3 world, uint view) {
  vec4 q = map_views[view].map_from_world * vec4(world, 1.0);
  return vec4(2.0 * q.xy - q.w, q.z, q.w);
}

#include "shadow/parameterization/texels.glsl"
