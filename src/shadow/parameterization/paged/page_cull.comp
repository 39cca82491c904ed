// Finds the clusters of instances that touch a page to draw, and at which levels they may.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Clusters { ClusterData clusters[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Instances { InstanceData instances[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Draw { uint draw[]; };
layout(set = 0, binding = 3, scalar) readonly buffer DrawOrFiner { uint draw_or_finer[]; };
layout(set = 0, binding = 4, scalar) buffer StateOut { PageState state; };
layout(set = 0, binding = 5, scalar) writeonly buffer Touched { PageCluster touched[]; };
layout(push_constant, scalar) uniform Push { BinConstants constants; };

// Levels at which a box of the map may touch pages to draw. Tested page by page from the coarsest level on, down to where the
// box has more pages than are worth a look.
uint touched_levels(uint face, vec2 low, vec2 high) {
  const int worth = 4;
  uint levels = 0;
  for (int level = int(paged.top); level >= int(page_state.finest); --level) {
    float size = level_size(level);
    // A triangle that has no texel's centre in reach leaves no trace.
    float slack = constants.reach + 1.0 / 64.0;
    vec2 first = clamp(ceil(low * size - 0.5 - slack), vec2(0.0), vec2(size)),
         last = clamp(floor(high * size - 0.5 + slack), vec2(-1.0), vec2(size - 1.0));
    if (any(greaterThan(first, last))) continue;
    ivec2 a = ivec2(first) / int(page_texels), b = ivec2(last) / int(page_texels);
    if (any(greaterThanEqual(b - a, ivec2(worth)))) return levels | ((2u << level) - 1u);
    bool any_finer = false;
    for (int y = a.y; y <= b.y; ++y)
      for (int x = a.x; x <= b.x; ++x) {
        uint index = page_index(face, level, uvec2(x, y)), bit = 1u << (index & 31u);
        if ((draw[index >> 5] & bit) != 0) levels |= 1u << level;
        any_finer = any_finer || (draw_or_finer[index >> 5] & bit) != 0;
      }
    if (!any_finer) break;
  }
  return levels;
}

void main() {
  uint index = gl_GlobalInvocationID.x;
  if (index >= constants.cluster_count || page_state.pages_drawn == 0) return;
  ClusterData cluster = clusters[index];
  for (uint i = 0; i < cluster.instance_count; ++i) {
    uint instance = cluster.first_instance + i;
    if ((instances[instance].kind & constants.kinds) == 0) continue;
    mat4x3 world_from_mesh = instances[instance].world_from_mesh;
    for (uint face = 0; face < paged.faces; ++face) {
      vec2 low = vec2(1e30), high = vec2(-1e30);
      bool behind = false, before = false;
      for (int corner = 0; corner < 8; ++corner) {
        vec3 side = vec3(corner & 1, corner >> 1 & 1, corner >> 2) * 2.0 - 1.0;
        vec3 world = world_from_mesh * vec4(cluster.center + side * cluster.half_extent, 1.0);
        vec4 q = map_views[face].map_from_world * vec4(world, 1.0);
        if (q.w < paged.near[face]) {
          behind = true;
        } else {
          before = true;
          low = min(low, q.xy / q.w);
          high = max(high, q.xy / q.w);
        }
      }
      if (!before) continue;
      if (behind) {
        low = vec2(0.0);
        high = vec2(1.0);
      }
      uint levels = touched_levels(face, low, high);
      if (levels == 0) continue;
      uint place = atomicAdd(state.visible_clusters, 1);
      if (place < constants.cluster_capacity) 
        touched[place] = PageCluster(index, instance, face, levels, atomicAdd(state.triangles, cluster.index_count / 3));
    }
  }
}
