// What parameterizations share whose texels lie side by side in a layer. Needs their map_unproject before it.

// The texel that p lies in; places of texels are p.uv / p.texel.
ivec2 map_texel(MapPoint p) { return ivec2(floor(p.uv * lookup.map_size)); }

// Map depth that a texel's width along the light makes.
float map_slope_unit(MapPoint p) { return map_view(p.layer).slope_unit; }

// The texel at p's own plus `offset`; false outside the layer.
bool map_fetch(MapPoint p, ivec2 offset, out ivec3 address) {
  address = ivec3(map_texel(p) + offset, int(p.layer));
  return all(greaterThanEqual(address.xy, ivec2(0))) && all(lessThan(address.xy, ivec2(lookup.map_size)));
}

#include "shadow/parameterization/ray.glsl"
