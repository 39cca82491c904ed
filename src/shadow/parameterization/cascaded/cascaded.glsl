// cascaded: one layer a slice of the camera's view, finest first. The parameterization module of a look-up (architecture,
// section 1).
// A receiver takes the first cascade whose map holds it and all that a filter reads around it, whatever its depth in the view:
// cascades reach beyond their slices, so that more receivers get fine texels, and no filter ever crosses from map to map.
#define MAP_SEVERAL_VIEWS 1
#include "shadow/map_point.glsl"
#include "shadow/parameterization/cascaded/shared.h"

#define MAP_CONTIGUOUS 1  // neighbours of a texel are its neighbours in the layer

layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 8, scalar) uniform Cascades { CascadeData cascades; };

// `cascades.count` where none holds the receiver.
uint cascade_of(vec3 world) {
  for (uint i = 0; i < cascades.count; ++i) {
    if (map_views[i].drawn == 0) continue;
    vec4 q = map_views[i].map_from_world * vec4(world, 1.0);
    vec2 from_center = abs(q.xy - 0.5 * q.w);
    if (q.w > 0.0 && all(lessThan(from_center, (0.5 - cascades.border[i]) * q.w))) return i;
  }
  return cascades.count;
}

MapPoint map_point(vec3 world, vec4 plane) {
  uint cascade = cascade_of(world);
  MapPoint p = map_project(map_views[min(cascade, cascades.count - 1)], cascade, world, plane, 1.0 / lookup.map_size);
  p.valid = p.valid && cascade < cascades.count;
  return p;
}

vec3 map_unproject(MapPoint p, vec2 uv, float depth) { return map_unproject_view(map_views[p.layer], uv, depth); }

#include "shadow/parameterization/layered.glsl"
