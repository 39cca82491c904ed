// hard: one texel answers.
float filter_visible(vec3 world, vec4 plane) { return storage_visible(map_point(world, plane)); }

// The same in passes, for storages that tell more and more at a growing price: false leaves the answer to the next pass.
#ifdef STORAGE_PASSES
#define FILTER_PASSES 4

bool filter_pass(uint pass, vec3 world, vec4 plane, out float visible) {
  MapPoint p = map_point(world, plane);
  visible = 1.0;
  if (pass == 0) return storage_lit(p);
  if (pass == 1) return storage_texel(p, visible);
  if (pass == 2) return storage_near(p, visible);
  visible = storage_recover(p);
  return true;
}
#endif
