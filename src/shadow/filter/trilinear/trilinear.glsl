// trilinear: 2x2 percentage-closer filtering in the two levels around the pixel's, blended (RMSM, section 3.3.1).

// The four texel centres around `world` at a level, each compared with the depth of the receiver's plane there and weighted
// bilinearly. A tap is mapped anew: it may lie on another page, or be answered by a coarser page than its neighbours.
float trilinear_level(vec3 world, vec4 plane, uint level) {
  MapPoint p = map_point_at(world, plane, level);
  if (!p.valid) return 1.0;
  vec2 corner = p.uv / p.texel - 0.5;
  vec2 first = floor(corner), weight = corner - first;
  vec3 at;
  if (map_quad(p, first, at)) {
    // As textureGather has them: (left bottom, right bottom, right top, left top).
    vec2 slope = p.gradient * p.texel;
    vec4 threshold = map_threshold(p) + (vec4(0, 1, 1, 0) - weight.x) * slope.x + (vec4(1, 1, 0, 0) - weight.y) * slope.y;
    vec4 lit = storage_gather(at, threshold);
    return dot(mix(vec2(lit.w, lit.x), vec2(lit.z, lit.y), weight.x), vec2(1.0 - weight.y, weight.y));
  }
  float lit = 0.0;
  for (int k = 0; k < 4; ++k) {
    vec2 step = vec2(k & 1, k >> 1);
    vec2 share = mix(1.0 - weight, weight, step);
    lit += share.x * share.y * storage_visible(map_tap(p, (first + step + 0.5) * p.texel));
  }
  return lit;
}

float filter_visible(vec3 world, vec4 plane) {
  float level = map_level(world, plane);
  uint fine = uint(level);
  float visible = trilinear_level(world, plane, fine);
  return mix(visible, trilinear_level(world, plane, fine + 1u), fract(level));
}
