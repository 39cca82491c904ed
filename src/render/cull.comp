// Finds, for each view, the instances of each cluster that its planes do not exclude, and writes one indirect draw a cluster.
// One invocation a cluster and view: its instances are listed in order, so that the same frame draws the same list.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "render/shared.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer Clusters { ClusterData clusters[]; };
layout(binding = 1, scalar) readonly buffer Instances { InstanceData instances[]; };
layout(binding = 2, scalar) readonly buffer Views { CullView views[]; };
layout(binding = 3, scalar) readonly buffer Order { uint order[]; };
layout(binding = 4, scalar) writeonly buffer Draws { DrawCommand draws[]; };
layout(binding = 5, scalar) writeonly buffer Visible { VisibleInstance visible[]; };
layout(push_constant, scalar) uniform Push { CullConstants constants; };

bool outside(InstanceData instance, ClusterData cluster, uint view) {
  mat3 linear = mat3(instance.world_from_mesh);
  vec3 center = instance.world_from_mesh * vec4(cluster.center, 1.0);
  for (uint i = 0; i < views[view].plane_count; ++i) {
    vec4 plane = views[view].planes[i];
    float reach = dot(abs(plane.xyz * linear), cluster.half_extent);
    if (dot(plane.xyz, center) + plane.w < -reach) return true;
  }
  return false;
}

void main() {
  uint slot = gl_GlobalInvocationID.x, view = gl_GlobalInvocationID.y;
  if (slot >= constants.cluster_count) return;
  ClusterData cluster = clusters[order[slot]];
  uint base = view * constants.list_capacity + cluster.list_base;
  uint count = 0, listed = (cluster.index_count / 3 + listed_alignment - 1) / listed_alignment * listed_alignment;
  for (uint i = 0; i < cluster.instance_count; ++i) {
    uint instance = cluster.first_instance + i;
    if ((instances[instance].kind & views[view].kinds) == 0 || outside(instances[instance], cluster, view)) continue;
    mat3x4 rows = transpose(instances[instance].world_from_mesh);
    uint body = cluster.body | (determinant(mat3(instances[instance].world_from_mesh)) < 0.0 ? body_mirrored : 0);
    visible[base + count] = VisibleInstance(vec4[3](rows[0], rows[1], rows[2]), instances[instance].albedo, cluster.first_index / 3 | body, 0, cluster.first_listed + count * listed);
    ++count;
  }
  draws[view * constants.cluster_count + slot] = DrawCommand(cluster.index_count, count, cluster.first_index, 0, base);
}
