// The sides of a view's casters (see caster_sides.h): four bits a triangle, side_drawn and a bit a silhouette edge;
// and, if asked for, the drawn ones' indices with a draw for each visible instance, and small triangles apart from
// these. One subgroup a place in the list of visible instances, in order, so that the same frame makes the same lists.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require
#include "render/shared.h"
#include "shadow/map_point.glsl"
#include "shadow/storage/subpixel/side.glsl"
#include "shadow/storage/subpixel/small_triangle.glsl"

layout(constant_id = 1) const bool splits = false;  // small triangles are listed apart

layout(local_size_x = 32) in;
layout(set = 0, binding = 0, scalar) readonly buffer Clusters { ClusterData clusters[]; };
layout(set = 0, binding = 1, scalar) readonly buffer ListedClusters { uint listed_clusters[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Draws { DrawCommand draws[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Visible { VisibleInstance visible[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Indices { uvec3 indices[]; };
layout(set = 0, binding = 5, scalar) readonly buffer FoldNormals { uvec4 fold_normals[]; };
layout(set = 0, binding = 6, scalar) readonly buffer FoldOffsets { vec4 fold_offsets[]; };
layout(set = 0, binding = 7, scalar) buffer Sides { uint sides[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer KeptIndices { uvec3 kept_indices[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer KeptDraws { DrawCommand kept_draws[]; };
layout(set = 0, binding = 10, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 11, scalar) writeonly buffer SmallTriangles { SmallTriangle small_triangles[]; };
layout(set = 0, binding = 12, scalar) writeonly buffer SmallLists { SmallList small_lists[]; };
layout(push_constant, scalar) uniform Push { SidesConstants constants; };

// A vertex in the map: texels, depth, and w.
vec4 corner(vec3 mesh, VisibleInstance instance, mat4 map_from_world) {
  vec4 p = vec4(mesh, 1.0);
  vec3 world = vec3(dot(instance.world_from_mesh_rows[0], p), dot(instance.world_from_mesh_rows[1], p), dot(instance.world_from_mesh_rows[2], p));
  vec4 q = map_from_world * vec4(world, 1.0);
  vec2 clip = 2.0 * q.xy - q.w;  // as layered.glsl and casters.geom go, so that a triangle's bits are the same by both ways
  return vec4((0.5 * clip / q.w + 0.5) * lookup.map_size, q.z / q.w, q.w);
}

// What a subgroup's invocations have that ask for it: places one after the other, in their order.
uint append(bool asks, inout uint count) {
  uvec4 ballot = subgroupBallot(asks);
  uint place = count + subgroupBallotExclusiveBitCount(ballot);
  count += subgroupBallotBitCount(ballot);
  return place;
}

void list(uint place) {
  uint cluster_index = listed_clusters[place];
  ClusterData cluster = clusters[cluster_index];
  uint visible_count = draws[constants.view * constants.cluster_count + cluster_index].instance_count;
  bool shown = place - cluster.list_base < visible_count;
  uint at = constants.view * constants.list_capacity + place, first = cluster.first_index / 3;
  VisibleInstance instance = visible[at];
  vec4 light = light_from_mesh(instance.world_from_mesh_rows);
  mat4 map_from_world = map_views[constants.view].map_from_world;
  float unit = map_views[constants.view].slope_unit;
  SlopeCoding coding = lookup.slope_coding;
  uint averted = (instance.first_triangle & body_closed) != 0 ? triangle_averted : 0;
  uint count = shown ? cluster.index_count / 3 : 0, listed = 0;
  uint small_count = 0, begin = shown ? instance.first_listed : 0;  // else it is what the memory held
  for (uint from = 0; from < count; from += gl_SubgroupSize) {
    uint t = from + gl_SubgroupInvocationID;
    bool drawn = t < count;
    uvec4 normals = drawn ? fold_normals[first + t] : uvec4(no_normal);
    vec4 offsets = light_kind() != light_directional && drawn ? fold_offsets[first + t] : vec4(0.0);
    bool facing = faces_light(normals.x, offsets.x, light);
    drawn = drawn && !is_left_out(facing, instance.first_triangle);
    uint silhouettes = silhouette_bits(normals, offsets, light, facing);
    uvec3 corners = drawn && constants.compact != 0 ? indices[first + t] : uvec3(0);
    if (splits) {
      vec4 a = corner(positions[corners.x], instance, map_from_world), b = corner(positions[corners.y], instance, map_from_world),
           c = corner(positions[corners.z], instance, map_from_world);
      SmallTriangle small;
      bool is_small = make_small(a, b, c, silhouettes | averted, coding, unit, small) && drawn;
      uint small_at = begin + append(is_small, small_count);
      if (is_small) small_triangles[small_at] = small;
      drawn = drawn && !is_small;
    }
    uint listed_at = constants.compact != 0 ? append(drawn, listed) : t;
    if (!drawn) continue;
    listed_at += begin;
    if (constants.compact != 0) kept_indices[listed_at] = corners;
    atomicOr(sides[listed_at / sides_per_word], (side_drawn | silhouettes) << (32 / sides_per_word * (listed_at % sides_per_word)));
  }
  if (!subgroupElect()) return;
  if (splits) small_lists[place] = SmallList(begin, begin + small_count);
  if (constants.compact != 0) kept_draws[place] = DrawCommand(3 * listed, shown ? 1 : 0, 3 * begin, 0, at);
}

void main() {
  for (uint place = gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID; place < constants.list_capacity;
       place += gl_NumWorkGroups.x * gl_NumSubgroups)
    list(place);
}
