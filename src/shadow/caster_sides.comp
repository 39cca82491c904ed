// The sides of a view's casters (see caster_sides.h): four bits a triangle, side_drawn and a bit a silhouette edge;
// and, if asked for, the drawn ones' indices with a draw for each visible instance. One invocation a place in the list
// of visible instances, in order, so that the same frame makes the same list.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "render/shared.h"
#include "shadow/map_point.glsl"
#include "shadow/storage/subpixel/side.glsl"

layout(local_size_x = 32) in;
layout(set = 0, binding = 0, scalar) readonly buffer Clusters { ClusterData clusters[]; };
layout(set = 0, binding = 1, scalar) readonly buffer ListedClusters { uint listed_clusters[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Draws { DrawCommand draws[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Visible { VisibleInstance visible[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Indices { uvec3 indices[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Neighbours { uvec3 neighbours[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer Sides { uint sides[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer KeptIndices { uvec3 kept_indices[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer KeptDraws { DrawCommand kept_draws[]; };
layout(push_constant, scalar) uniform Push { SidesConstants constants; };

vec3 world_position(VisibleInstance instance, uint vertex) {
  vec4 p = vec4(positions[vertex], 1.0);
  return vec3(dot(instance.world_from_mesh_rows[0], p), dot(instance.world_from_mesh_rows[1], p),
              dot(instance.world_from_mesh_rows[2], p));
}

void main() {
  uint place = gl_GlobalInvocationID.x;
  if (place >= constants.list_capacity) return;
  uint cluster_index = listed_clusters[place];
  ClusterData cluster = clusters[cluster_index];
  uint visible_count = draws[constants.view * constants.cluster_count + cluster_index].instance_count;
  bool shown = place - cluster.list_base < visible_count;
  uint at = constants.view * constants.list_capacity + place, first = cluster.first_index / 3;
  VisibleInstance instance = visible[at];
  uint count = shown ? cluster.index_count / 3 : 0, listed = 0, word = 0;
  for (uint t = 0; t < count; ++t) {
    uvec3 corners = indices[first + t];
    vec3 world[3] = vec3[3](world_position(instance, corners.x), world_position(instance, corners.y),
                            world_position(instance, corners.z));
    bool facing = faces_light(world[0], world[1], world[2]);
    uint side = 0;
    if (!is_left_out(facing, instance.first_triangle)) {
      side = side_drawn;
      uvec3 across = neighbours[first + t];
      for (int e = 0; e < 3; ++e) {
        bool open = across[e] == no_vertex;
        vec3 beyond = open ? vec3(0.0) : world_position(instance, across[e]);
        side |= silhouette_bit(e, world, open, beyond, facing);
      }
    }
    if (constants.compact != 0 && side == 0) continue;
    if (constants.compact != 0) kept_indices[instance.first_listed + listed] = corners;
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
