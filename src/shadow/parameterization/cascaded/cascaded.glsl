// cascaded: one layer a slice of the camera's view, finest first. The parameterization module of a look-up (architecture,
// section 1).
// A receiver takes the first cascade whose map holds it and all that a filter reads around it, whatever its depth in the view:
// cascades reach beyond their slices, so that more receivers get fine texels, and no filter ever crosses from map to map.
#define MAP_SEVERAL_VIEWS 1
#include "shadow/map_point.glsl"
#include "shadow/parameterization/cascaded/shared.h"

#define MAP_CONTIGUOUS 1  // neighbours of a texel are its neighbours in the layer

layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 1, scalar) SHADEWRIGHT_UNIFORM(CascadeData, cascades, load_map)

// Where it is known when the look-up is compiled, how many there are.
layout(constant_id = 3) const uint known_cascades = 0;

// Takes cascade `i` for what lies at `q` of the light's plane (see CascadeData), if it holds that.
void take_cascade(uint i, vec4 q, inout uint cascade, inout CascadeWindow window) {
  if (known_cascades != 0 && i >= known_cascades) return;
  CascadeWindow w = cascades.windows[i];
  vec2 from_center = abs(w.turn * q.xy + (w.offset - 0.5) * q.w);
  bool holds = all(lessThan(from_center, (0.5 - w.border) * q.w));
  cascade = holds ? i : cascade;
  window.turn = mat2(holds ? w.turn[0] : window.turn[0], holds ? w.turn[1] : window.turn[1]);
  window.offset = holds ? w.offset : window.offset;
}

// The cascade that takes what lies at `q`, and its window; `max_cascades` where none does. All are compared, without a branch (see
// loads_first.glsl) and without a loop, which Mesa 22.3 would not unroll.
uint cascade_of(vec4 q, out CascadeWindow window) {
  uint cascade = max_cascades;
  window = cascades.windows[0];
  take_cascade(7, q, cascade, window);
  take_cascade(6, q, cascade, window);
  take_cascade(5, q, cascade, window);
  take_cascade(4, q, cascade, window);
  take_cascade(3, q, cascade, window);
  take_cascade(2, q, cascade, window);
  take_cascade(1, q, cascade, window);
  take_cascade(0, q, cascade, window);
  return cascade;
}

MapPoint map_point(vec3 world, vec4 plane) {
  vec4 q = cascades.light_from_world * vec4(world, 1.0);
  vec4 plane_light = plane * cascades.world_from_light;
  CascadeWindow window;
  uint cascade = cascade_of(q, window);
  // A plane turns by the inverse transpose.
  vec2 plane_map = vec2(window.turn[1].y * plane_light.x - window.turn[0].y * plane_light.y,
                        window.turn[0].x * plane_light.y - window.turn[1].x * plane_light.x) / determinant(window.turn);
  vec3 depth_row = vec3(cascades.light_from_world[0].z, cascades.light_from_world[1].z, cascades.light_from_world[2].z);
  MapPoint p = map_projected(vec4(window.turn * q.xy + window.offset * q.w, q.zw), vec3(plane_map, plane_light.z), depth_row,
                             cascade, world, 1.0 / lookup.map_size);
  p.valid = p.valid && cascade < max_cascades;
  return p;
}

vec3 map_unproject(MapPoint p, vec2 uv, float depth) { return map_unproject_view(map_views[p.layer], uv, depth); }

#include "shadow/parameterization/layered.glsl"
