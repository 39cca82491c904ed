// Where a cluster's box lies in flat coordinates. Needs rectilinear.glsl before it.

struct FlatBounds {
  vec2 low, high;
  bool in_front;  // of the light; else it may lie anywhere
};

FlatBounds flat_bounds(VisibleInstance instance, ClusterData cluster) {
  mat3x4 rows = mat3x4(instance.world_from_mesh_rows[0], instance.world_from_mesh_rows[1], instance.world_from_mesh_rows[2]);
  FlatBounds bounds = FlatBounds(vec2(1.0 / 0.0), vec2(-1.0 / 0.0), true);
  for (int corner = 0; corner < 8; ++corner) {
    vec3 side = vec3(corner & 1, (corner >> 1) & 1, corner >> 2) * 2.0 - 1.0;
    vec4 h = map_caster_flat(vec4(cluster.center + side * cluster.half_extent, 1.0) * rows, 0);
    bounds.in_front = bounds.in_front && h.w > 0.0;
    bounds.low = min(bounds.low, h.xy / h.w);
    bounds.high = max(bounds.high, h.xy / h.w);
  }
  return bounds;
}
