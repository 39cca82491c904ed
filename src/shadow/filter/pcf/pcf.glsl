// pcf: percentage-closer filtering (Reeves et al. 1987): the lit share of a box around the receiver, each texel weighted by
// how much of it the box covers, each compared with the depth of the receiver's plane at its own centre.
// The box is `radius` texels wide to each side, or `width` metres on the receiver, the same at every resolution.

#ifdef STORAGE_PREFILTERED
// The storage has averaged its texels already: one look-up, blended between them.
float filter_visible(vec3 world, vec4 plane) { return storage_filtered(map_point(world, plane)); }
#else

// Half widths of the box in texels. Beyond `pcf_dense` the taps are spread evenly over the box instead of touching every texel.
const float pcf_dense = 8.0;

vec2 pcf_half_width(MapPoint p, vec3 world) {
  if (lookup.pcf_width <= 0.0) return vec2(lookup.pcf_radius);
  // A texel's extents across the light's direction: how far a step of a texel moves a point at the receiver's depth.
  vec3 here = map_unproject(p, p.uv, p.depth);
  float texel_u = distance(map_unproject(p, p.uv + vec2(p.texel.x, 0.0), p.depth), here);
  float texel_v = distance(map_unproject(p, p.uv + vec2(0.0, p.texel.y), p.depth), here);
  return max(vec2(0.5), lookup.pcf_width / vec2(texel_u, texel_v));
}

// How much of the texel at `index` the box [center - half, center + half] covers, per axis, in texels.
float pcf_cover(float index, float center, float half_width) {
  return max(0.0, min(center + half_width, index + 1.0) - max(center - half_width, index));
}

float filter_visible(vec3 world, vec4 plane) {
  MapPoint p = map_point(world, plane);
  if (!p.valid) return 1.0;
  vec2 half_width = pcf_half_width(p, world);
  vec2 center = p.uv / p.texel;
  vec2 first = floor(center - half_width);
  ivec2 pairs = ivec2(ceil((floor(center + half_width) - first + 1.0) * 0.5));
  ivec2 taken = min(pairs, ivec2(pcf_dense + 1.0));
  vec2 stride = vec2(pairs) / vec2(taken);
  vec2 slope = p.gradient * p.texel;
  float own = map_threshold(p);
  float lit = 0.0, covered = 0.0;
  for (int j = 0; j < taken.y; ++j)
    for (int i = 0; i < taken.x; ++i) {
      vec2 block = first + 2.0 * floor((vec2(i, j) + 0.5) * stride);
      vec4 weights = vec4(pcf_cover(block.x, center.x, half_width.x), pcf_cover(block.x + 1.0, center.x, half_width.x),
                          pcf_cover(block.y, center.y, half_width.y), pcf_cover(block.y + 1.0, center.y, half_width.y));
      vec2 at = (block + 0.5 - center) * slope;  // depth of the plane at the block's first texel centre, per axis
#ifdef MAP_CONTIGUOUS
      MapPoint tap = p;
      tap.uv = (block + 1.0) * p.texel;
      vec4 thresholds = own + at.x + at.y + vec4(slope.y, slope.x + slope.y, slope.x, 0.0);
      vec4 cover = weights.xyyx * weights.wwzz;
      lit += dot(storage_visible4(tap, thresholds), cover);
      covered += dot(cover, vec4(1.0));
#else
      for (int k = 0; k < 4; ++k) {
        vec2 corner = vec2(k & 1, k >> 1);
        float cover = weights[k & 1] * weights[2 + (k >> 1)];
        if (cover <= 0.0) continue;
        vec2 uv = (block + corner + 0.5) * p.texel;
        // A tap on the receiver's plane, mapped anew: it may lie on another page or face.
        vec3 world_tap = map_unproject(p, uv, p.depth + dot(uv - p.uv, p.gradient));
        lit += cover * storage_visible(map_point(world_tap, plane));
        covered += cover;
      }
#endif
    }
  return covered > 0.0 ? lit / covered : 1.0;
}

#endif
