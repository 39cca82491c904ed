// hard: one texel answers.
float filter_visible(vec3 world, vec4 plane) { return storage_visible(map_point(world, plane)); }
