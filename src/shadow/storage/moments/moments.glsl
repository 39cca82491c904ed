// moments: a texel keeps mean and variance of the light's distance (Donnelly and Lauritzen, "Variance Shadow Maps", I3D 2006).
// The storage module of a look-up; needs a parameterization before it.
#include "shadow/storage/moments/light_distance.glsl"

// Texels were averaged beforehand: a filter is one look-up, storage_filtered.
#define STORAGE_PREFILTERED 1

layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 8) uniform sampler2DArray moments_map;

// The light's distance at p's place and another depth of the map.
float moments_distance_at(MapPoint p, float depth) {
  return moments_distance(map_unproject(p, p.uv, depth) - moments_origin());
}

// The float error of a receiver's distance.
float moments_error(MapPoint p) { return moments_distance_at(p, p.depth) - moments_distance_at(p, p.depth - p.tolerance); }

// The largest share of occluders that may lie beyond `distance` (Chebyshev's one-sided inequality, equation 5), with the part
// below `lookup.light_bleeding` cut off.
float moments_lit(vec2 moments, float distance, float least_variance) {
  float behind = distance - moments.r;
  if (behind <= 0.0) return 1.0;
  float variance = max(moments.g, least_variance);
  float share = variance / (variance + behind * behind);
  return clamp((share - lookup.light_bleeding) / (1.0 - lookup.light_bleeding), 0.0, 1.0);
}

// One texel.
float storage_visible(MapPoint p) {
  ivec3 address;
  if (!p.valid || !map_fetch(p, ivec2(0), address)) return 1.0;
  float error = moments_error(p);
  return moments_lit(texelFetch(moments_map, address, 0).rg, moments_distance_at(p, map_threshold(p)), error * error);
}

// The four texels around the receiver, weighted bilinearly: mean and variance of the blend, by the law of total variance. On a
// plane the blend's mean is the receiver's own distance, however steep it is: float error alone has to be forgiven.
float storage_filtered(MapPoint p) {
  if (!p.valid) return 1.0;
  float distance = moments_distance_at(p, p.depth), error = moments_error(p);
  vec2 at = clamp(p.uv, 0.5 * p.texel, 1.0 - 0.5 * p.texel) / p.texel - 0.5;
  ivec2 first = min(ivec2(at), ivec2(lookup.map_size) - 2);
  vec2 share = at - vec2(first);
  vec4 weights = vec4((1.0 - share.x) * (1.0 - share.y), share.x * (1.0 - share.y), (1.0 - share.x) * share.y, share.x * share.y);
  float mean = 0.0, squares = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 m = texelFetch(moments_map, ivec3(first + ivec2(i & 1, i >> 1), int(p.layer)), 0).rg;
    float d = m.r - distance;
    mean += weights[i] * d;
    squares += weights[i] * (d * d + m.g);
  }
  return moments_lit(vec2(mean, max(squares - mean * mean, 0.0)), -lookup.bias_scale * error, error * error);
}
