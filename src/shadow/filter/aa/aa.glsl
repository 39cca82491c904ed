// aa: the storage's own anti-aliasing (SPSM section 4.3). The shadow's border that one look-up found answers for all places of the
// pixel's footprint on the receiver's plane; a footprint beyond the texels that it looked at is looked up place by place.
// Where a border passes alone, what is on which side of one half is then decided by the pixel's middle, as `hard` decides it. Among leaves
// farther away than that, the pixel's larger part differs from its middle in truth too: there a filter is "wrong" where `hard` is right.
#define FILTER_LONG 1  // a look-up answers a pixel at a time
#define FILTER_FOOTPRINT 1
#define FILTER_PASSES 2

// How far a step of one pixel moves the receiver over its plane, world space: the caller's business.
vec3 filter_step_x, filter_step_y;

const uint aa_count = 9;
// In pixels. They share neither row nor column, and lie in pairs around the middle one: of any straight border the middle is then on the
// side of most of them, as it is on the larger side of the footprint.
const vec2 aa_places[aa_count] = vec2[aa_count](vec2(0.0), vec2(1.0, 3.0) / 9.0, vec2(-1.0, -3.0) / 9.0, vec2(3.0, -1.0) / 9.0,
                                                vec2(-3.0, 1.0) / 9.0, vec2(2.0, -4.0) / 9.0, vec2(-2.0, 4.0) / 9.0, vec2(4.0, 2.0) / 9.0,
                                                vec2(-4.0, -2.0) / 9.0);

struct Footprint {
  vec2 step_x, step_y;  // of the pixel on the map, texels
  float reach;
};

// False if it reaches beyond the texels that one look-up sees.
bool footprint_at(MapPoint p, vec3 world, vec4 plane, out Footprint f) {
  MapPoint x = map_point(world + filter_step_x, plane), y = map_point(world + filter_step_y, plane);
  f.step_x = (x.uv - p.uv) / p.texel;
  f.step_y = (y.uv - p.uv) / p.texel;
  f.reach = 0.5 * (length(f.step_x) + length(f.step_y));
  return x.layer == p.layer && y.layer == p.layer && f.reach < 1.0;
}

// The footprint's lit share, if its middle is `visible` and the shadow's border passes at `border`, texels from it: a parallelogram cut by
// a line. Where the line passes through the middle, that keeps its side.
float footprint_visible(Footprint f, float visible, vec2 border) {
  float away = length(border), a = abs(dot(f.step_x, border)), b = abs(dot(f.step_y, border));
  float wide = max(a, b) / max(away, 1e-9), narrow = min(a, b) / max(away, 1e-9);
  float corner = max(0.5 * (wide + narrow) - away, 0.0);  // how far the farthest one is beyond
  float beyond = corner < narrow ? 0.5 * corner * corner / (wide * narrow) : 0.5 - away / wide;
  return visible == 1.0 ? 1.0 - beyond : min(beyond, 127.0 / 255.0);
}

// In two passes: what one texel tells, and where that is not enough (false), the rest.
bool filter_quick(vec3 world, vec4 plane, out float visible) {
  MapPoint p = map_point(world, plane);
  Footprint f;
  vec2 border;
  bool quick = storage_quick(p, visible) && footprint_at(p, world, plane, f) && storage_quick_border(p, visible, border);
  if (quick) visible = footprint_visible(f, visible, border);
  return quick;
}

float filter_deferred(vec3 world, vec4 plane) {
  MapPoint p = map_point(world, plane);
  Footprint f;
  bool at_once = footprint_at(p, world, plane, f);
  uint count = at_once ? 1 : aa_count;
  float lit = 0.0;
  for (uint i = 0; i < count; ++i) {
    if (!at_once) p = map_point(world + aa_places[i].x * filter_step_x + aa_places[i].y * filter_step_y, plane);
    lit += storage_visible(p);
  }
  return at_once ? footprint_visible(f, lit, storage_border(p, lit)) : lit / float(aa_count);
}

float filter_visible(vec3 world, vec4 plane) {
  float visible;
  return filter_quick(world, plane, visible) ? visible : filter_deferred(world, plane);
}

bool filter_pass(uint pass, vec3 world, vec4 plane, out float visible) {
  if (pass == 0) return filter_quick(world, plane, visible);
  visible = filter_deferred(world, plane);
  return true;
}
