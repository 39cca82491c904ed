// What parameterizations share whose texels lie side by side in a layer. Needs their map_unproject before it.

// The texel at p's own plus `offset`; false outside the layer.
bool map_fetch(MapPoint p, ivec2 offset, out ivec3 address) {
  address = ivec3(ivec2(floor(p.uv * lookup.map_size)) + offset, int(p.layer));
  return all(greaterThanEqual(address.xy, ivec2(0))) && all(lessThan(address.xy, ivec2(lookup.map_size)));
}

#include "shadow/parameterization/ray.glsl"
