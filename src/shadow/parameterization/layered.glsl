// What parameterizations share whose views fill a layer each through one matrix. Needs their map_unproject before it.

vec4 map_caster(vec3 world, uint view) {
  vec4 q = map_views[view].map_from_world * vec4(world, 1.0);
  return vec4(2.0 * q.xy - q.w, q.z, q.w);
}

// The texel at p's own plus `offset`; false outside the layer.
bool map_fetch(MapPoint p, ivec2 offset, out ivec3 address) {
  address = ivec3(ivec2(floor(p.uv * lookup.map_size)) + offset, int(p.layer));
  return all(greaterThanEqual(address.xy, ivec2(0))) && all(lessThan(address.xy, ivec2(lookup.map_size)));
}

Ray map_ray(MapPoint p, vec2 uv) {
  vec3 near = map_unproject(p, uv, 0.0);
  return Ray(near, normalize(map_unproject(p, uv, 1.0) - near));
}
