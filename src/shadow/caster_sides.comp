// The sides of a view's casters (see caster_sides.h): four bits a triangle, side_drawn and a bit a silhouette edge;
// and, if asked for, the drawn ones' indices with a draw for each visible instance. One invocation a place in the list
// of visible instances, in order, so that the same frame makes the same list.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "render/shared.h"
#include "shadow/map_point.glsl"
#include "shadow/storage/subpixel/side.glsl"

layout(constant_id = 1) const bool light_has_position = true;  // else no plane needs its offset

layout(local_size_x = 32) in;
layout(set = 0, binding = 0, scalar) readonly buffer Clusters { ClusterData clusters[]; };
layout(set = 0, binding = 1, scalar) readonly buffer ListedClusters { uint listed_clusters[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Draws { DrawCommand draws[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Visible { VisibleInstance visible[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Indices { uvec3 indices[]; };
layout(set = 0, binding = 5, scalar) readonly buffer FoldNormals { uvec4 fold_normals[]; };
layout(set = 0, binding = 6, scalar) readonly buffer FoldOffsets { vec4 fold_offsets[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer Sides { uint sides[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer KeptIndices { uvec3 kept_indices[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer KeptDraws { DrawCommand kept_draws[]; };
layout(push_constant, scalar) uniform Push { SidesConstants constants; };

void main() {
  uint place = gl_GlobalInvocationID.x;
  if (place >= constants.list_capacity) return;
  uint cluster_index = listed_clusters[place];
  ClusterData cluster = clusters[cluster_index];
  uint visible_count = draws[constants.view * constants.cluster_count + cluster_index].instance_count;
  bool shown = place - cluster.list_base < visible_count;
  uint at = constants.view * constants.list_capacity + place, first = cluster.first_index / 3;
  VisibleInstance instance = visible[at];
  vec4 light = light_from_mesh(instance.world_from_mesh_rows);
  uint count = shown ? cluster.index_count / 3 : 0, listed = 0, word = 0;
  for (uint t = 0; t < count; ++t) {
    uvec4 normals = fold_normals[first + t];
    vec4 offsets = light_has_position ? fold_offsets[first + t] : vec4(0.0);
    bool facing = faces_light(normals.x, offsets.x, light);
    uint side = 0;
    if (!is_left_out(facing, instance.first_triangle))
      side = side_drawn | silhouette_bits(normals, offsets, light, facing);
    if (constants.compact != 0 && side == 0) continue;
    if (constants.compact != 0) kept_indices[instance.first_listed + listed] = indices[first + t];
    word |= side << (32 / sides_per_word * (listed % sides_per_word));
    if (++listed % sides_per_word == 0) {
      sides[(instance.first_listed + listed) / sides_per_word - 1] = word;
      word = 0;
    }
  }
  if (listed % sides_per_word != 0) sides[(instance.first_listed + listed) / sides_per_word] = word;
  if (constants.compact != 0)
    kept_draws[place] = DrawCommand(3 * listed, shown ? 1 : 0, 3 * instance.first_listed, 0, at);
}
