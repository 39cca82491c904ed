// Where samples of importance go, and in which orientation. Bindings 3 to 6 of the analysis' passes, after receivers.glsl.
layout(set = 0, binding = 3, scalar) uniform Constants { WarpConstants constants; };
layout(set = 0, binding = 4, scalar) buffer Accumulated { Importance accumulated; };
layout(set = 0, binding = 6, scalar) buffer ImportanceMap { uint importance_map[]; };  // float bits

Orientation chosen_orientation() { return constants.orientations[orientation_index(accumulated.best_orientation)]; }

vec2 whole_of(Orientation o, vec2 map) { return clamp(vec2(dot(o.u, vec3(map, 1.0)), dot(o.v, vec3(map, 1.0))), 0.0, 1.0); }

// In [0, 1), of a pixel.
float noise(ivec2 pixel) {
  uint h = uint(pixel.x) * 0x9e3779b9u ^ uint(pixel.y) * 0x85ebca6bu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return float((h ^ (h >> 15)) >> 8) / 16777216.0;
}

// One sample, at `whole`. `add`: it stands in the sums too.
void accumulate(ivec2 pixel, vec2 whole, vec2 value, bool add) {
  // Looking before an atomic maximum: most samples raise nothing.
  if (two_dimensional) {
    uvec2 cell = min(uvec2(whole * float(constants.map_size)), constants.map_size - 1);
    uint at = cell.y * constants.map_size + cell.x, bits = floatBitsToUint(max(value.x, value.y));
    if (importance_map[at] < bits) atomicMax(importance_map[at], bits);
  }
  for (uint axis = 0; axis < 2; ++axis) {
    uint bin = axis * importance_bins + min(uint(whole[axis] * importance_bins), importance_bins - 1);
    uint bits = floatBitsToUint(value[axis]);
    if (!two_dimensional && accumulated.greatest[bin] < bits) atomicMax(accumulated.greatest[bin], bits);
    if (add) {
      // Rounded at random, so that small values count too.
      uint whole_number = uint(value[axis] * constants.sum_scale + noise(pixel));
      if (whole_number != 0) atomicAdd(accumulated.sums[bin], whole_number);
    }
  }
}
