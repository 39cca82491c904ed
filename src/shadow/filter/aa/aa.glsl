// aa: the storage's own anti-aliasing (SPSM section 4.3). The shadow's border that one look-up found answers for all places of the
// pixel's footprint on the receiver's plane; a footprint beyond the texels that it looked at is looked up place by place.
#define FILTER_FOOTPRINT 1

// How far a step of one pixel moves the receiver over its plane, world space: the caller's business.
vec3 filter_step_x, filter_step_y;

const uint aa_count = 8;
const vec2 aa_places[aa_count] = vec2[aa_count](  // eight that share neither row nor column, in pixels
    vec2(0.0625, -0.1875), vec2(-0.0625, 0.1875), vec2(0.3125, 0.0625), vec2(-0.1875, -0.3125), vec2(-0.3125, 0.3125),
    vec2(-0.4375, -0.0625), vec2(0.1875, 0.4375), vec2(0.4375, -0.4375));

float filter_visible(vec3 world, vec4 plane) {
  MapPoint p = map_point(world, plane);
  float visible = storage_visible(p);
  MapPoint x = map_point(world + filter_step_x, plane), y = map_point(world + filter_step_y, plane);
  vec2 step_x = (x.uv - p.uv) / p.texel, step_y = (y.uv - p.uv) / p.texel;
  float reach = 0.5 * (length(step_x) + length(step_y));
  if (x.layer == p.layer && y.layer == p.layer && reach < 1.0) {
    vec2 border = storage_border(p, visible);
    float squared = dot(border, border);
    if (squared > reach * reach) return visible;
    float beyond = 0.0;
    for (uint i = 0; i < aa_count; ++i)
      if (dot(aa_places[i].x * step_x + aa_places[i].y * step_y, border) > squared) beyond += 1.0 / float(aa_count);
    return visible == 1.0 ? 1.0 - beyond : beyond;
  }
  uint decision = storage_decision;
  float lit = 0.0;
  for (uint i = 0; i < aa_count; ++i)
    lit += storage_visible(map_point(world + aa_places[i].x * filter_step_x + aa_places[i].y * filter_step_y, plane));
  storage_decision = decision;
  return lit / float(aa_count);
}
