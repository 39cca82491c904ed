// hard: one texel answers.
float filter_visible(vec3 world, vec4 plane) { return storage_visible(map_point(world, plane)); }

// The same in two passes, for look-ups that put off what takes long.
#ifdef STORAGE_DEFERS
#define FILTER_DEFERS 1

bool filter_quick(vec3 world, vec4 plane, out float visible) { return storage_quick(map_point(world, plane), visible); }
float filter_deferred(vec3 world, vec4 plane) { return storage_deferred(map_point(world, plane)); }
#endif
