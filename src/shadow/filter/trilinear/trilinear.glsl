// trilinear: 2x2 percentage-closer filtering in the two levels around the pixel's, blended (RMSM, section 3.3.1).
#define FILTER_LONG 1  // a look-up answers a pixel at a time

// The four texel centres around `world` at a level, each compared with the depth of the receiver's plane there and weighted
// bilinearly. Those on the receiver's own page answer at once; then those of each other page, or one of a coarser page at a time.
float trilinear_level(vec3 world, vec4 plane, uint level) {
  MapPoint p = map_point_at(world, plane, level);
  if (!p.valid) return 1.0;
  // All fours are as textureGather has them: (left bottom, right bottom, right top, left top).
  const vec4 right = vec4(0, 1, 1, 0), bottom = vec4(1, 1, 0, 0);
  vec2 corner = p.uv / p.texel - 0.5;
  vec2 first = floor(corner), weight = corner - first, slope = p.gradient * p.texel;
  vec4 open = mix(vec4(1.0 - weight.x), vec4(weight.x), right) * mix(vec4(1.0 - weight.y), vec4(weight.y), bottom);  // not yet answered
  vec4 rise = (right - weight.x) * slope.x + (bottom - weight.y) * slope.y;
  MapPoint tap = p;       // whose page answers now,
  vec4 next = vec4(0.0);  // and the one of the four that it was looked up for
  float lit = 0.0;
  do {
    bool coarser = tap.texel.x != p.texel.x;
    vec2 step = vec2(dot(next, right), dot(next, bottom));
    vec3 at;
    vec4 here = vec4(map_quad(tap, coarser ? floor(tap.uv / tap.texel) - step : first, at));
    vec4 answered = coarser || !tap.valid ? next : max(here, next);
    tap.depth = p.depth;
    lit += dot(answered * open, tap.valid ? storage_gather(at, map_threshold(tap) + rise) : vec4(1.0));
    open *= 1.0 - answered;

    next = open.x > 0.0 ? vec4(1, 0, 0, 0) : open.y > 0.0 ? vec4(0, 1, 0, 0) : open.z > 0.0 ? vec4(0, 0, 1, 0) : vec4(0, 0, 0, 1);
    tap = map_tap(p, (first + vec2(dot(next, right), dot(next, bottom)) + 0.5) * p.texel);
  } while (any(greaterThan(open, vec4(0.0))));
  return lit;
}

float filter_visible(vec3 world, vec4 plane) {
  float level = map_level(world, plane);
  uint fine = uint(level);
  float visible = trilinear_level(world, plane, fine);
  return mix(visible, trilinear_level(world, plane, fine + 1u), fract(level));
}
