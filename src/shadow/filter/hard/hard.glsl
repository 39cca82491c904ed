// hard: one texel answers.
float filter_visible(vec3 world, vec4 plane) { return storage_visible(map_point(world, plane)); }

// The same in passes, for storages that tell more and more at a growing price.
#ifdef STORAGE_PASSES
#include "shadow/filter/passes.glsl"
#define FILTER_PASSES 3

uint filter_pass(uint pass, vec3 world, vec4 plane, out float visible) {
  MapPoint p = map_point(world, plane);
  if (pass == 0) return storage_quick(p, visible) ? filter_done : 1;
  if (pass == 1) return storage_near(p, visible) ? filter_done : 2;
  visible = storage_recover(p);
  return filter_done;
}
#endif
