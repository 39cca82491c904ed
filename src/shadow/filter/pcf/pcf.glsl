// pcf: percentage-closer filtering (Reeves et al. 1987): the lit share of a box around the receiver, each texel weighted by
// how much of it the box covers, each compared with the depth of the receiver's plane at its own centre.
// The box is `radius` texels wide to each side, or `width` metres on the receiver, the same at every resolution.

#ifdef STORAGE_PREFILTERED
// The storage has averaged its texels already: one look-up, blended between them.
float filter_visible(vec3 world, vec4 plane) { return storage_filtered(map_point(world, plane)); }
#else

#ifndef MAP_WARPED
vec2 map_flat(MapPoint p, vec2 uv) { return uv; }
vec2 map_unflat(MapPoint p, vec2 flat_uv) { return flat_uv; }
#endif

// Beyond `pcf_dense` the taps are spread evenly over the box instead of touching every texel.
const float pcf_dense = 8.0;

// Half the box: in flat coordinates (see map_flat) if it has a width in the world, else in uv.
vec2 pcf_half_size(MapPoint p) {
  if (lookup.pcf_width <= 0.0) return lookup.pcf_radius * p.texel;
  // A texel's extents across the light's direction: how far a step of a texel moves a point at the receiver's depth.
  vec3 here = map_unproject(p, p.uv, p.depth);
  vec2 beside = p.uv + p.texel * mix(vec2(1.0), vec2(-1.0), greaterThan(p.uv, vec2(0.5)));
  float texel_u = distance(map_unproject(p, vec2(beside.x, p.uv.y), p.depth), here);
  float texel_v = distance(map_unproject(p, vec2(p.uv.x, beside.y), p.depth), here);
  return max(vec2(0.5), lookup.pcf_width / vec2(texel_u, texel_v)) * abs(map_flat(p, beside) - map_flat(p, p.uv));
}

// Where a texel's lower edges lie, in what the box is measured in.
vec2 pcf_edge(MapPoint p, vec2 index) { return lookup.pcf_width > 0.0 ? map_flat(p, index * p.texel) : index * p.texel; }

float filter_visible(vec3 world, vec4 plane) {
  MapPoint p = map_point(world, plane);
  if (!p.valid) return 1.0;
  bool in_flat = lookup.pcf_width > 0.0;
  vec2 half_size = pcf_half_size(p), center = in_flat ? p.flat_uv : p.uv, low = center - half_size, high = center + half_size;
  vec2 first = floor((in_flat ? map_unflat(p, low) : low) / p.texel), last = floor((in_flat ? map_unflat(p, high) : high) / p.texel);
  ivec2 pairs = ivec2(ceil((last - first + 1.0) * 0.5));
  ivec2 taken = min(pairs, ivec2(pcf_dense + 1.0));
  vec2 stride = vec2(pairs) / vec2(taken);
  float own = map_threshold(p);
  float lit = 0.0, covered = 0.0;
  for (int j = 0; j < taken.y; ++j)
    for (int i = 0; i < taken.x; ++i) {
      vec2 block = first + 2.0 * floor((vec2(i, j) + 0.5) * stride);
      // How much of the block's columns and rows the box covers.
      vec2 edge0 = pcf_edge(p, block), edge1 = pcf_edge(p, block + 1.0), edge2 = pcf_edge(p, block + 2.0);
      vec2 cover0 = max(min(high, edge1) - max(low, edge0), 0.0), cover1 = max(min(high, edge2) - max(low, edge1), 0.0);
      vec4 weights = vec4(cover0.x, cover1.x, cover0.y, cover1.y);
#ifdef MAP_CONTIGUOUS
      MapPoint tap = p;
      tap.uv = (block + 1.0) * p.texel;
      // Depth of the plane at the block's texel centres, against the receiver's, per axis.
      vec2 at = (map_flat(p, (block + 0.5) * p.texel) - p.flat_uv) * p.flat_gradient;
      vec2 next = (map_flat(p, (block + 1.5) * p.texel) - p.flat_uv) * p.flat_gradient;
      vec4 thresholds = own + vec4(at.x + next.y, next.x + next.y, next.x + at.y, at.x + at.y);
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
        vec3 world_tap = map_unproject(p, uv, p.depth + dot(map_flat(p, uv) - p.flat_uv, p.flat_gradient));
        lit += cover * storage_visible(map_point(world_tap, plane));
        covered += cover;
      }
#endif
    }
  return covered > 0.0 ? lit / covered : 1.0;
}

#endif
