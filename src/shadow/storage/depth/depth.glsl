// depth: a texel keeps the depth of the closest occluder at its centre (Williams 1978).
// The storage module of a look-up; needs a parameterization before it.
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 8) uniform sampler2DArray depth_map;

float storage_visible(MapPoint p) {
  ivec3 address;
  if (!p.valid || !map_fetch(p, ivec2(0), address)) return 1.0;
  float occluder = texelFetch(depth_map, address, 0).r;
  return occluder < min(map_threshold(p), 1.0) ? 0.0 : 1.0;
}

// The four texels around the texel corner at `at` of the image, in textureGather's order. `thresholds` are the depths below which an
// occluder counts.
vec4 storage_gather(vec3 at, vec4 thresholds) {
  return vec4(greaterThanEqual(textureGather(depth_map, at), min(thresholds, 1.0)));
}

#ifdef MAP_CONTIGUOUS
// The four texels around the texel corner at p.uv: (left bottom, right bottom, right top, left top), as textureGather has them.
// `thresholds` are the depths below which an occluder counts, in that order.
vec4 storage_visible4(MapPoint p, vec4 thresholds) {
  vec4 occluders = textureGather(depth_map, vec3(p.uv, float(p.layer)));
  return vec4(greaterThanEqual(occluders, min(thresholds, 1.0)));
}
#endif
