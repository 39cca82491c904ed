// Structs that C++ and GLSL share, written once. GLSL reads them with scalar layout, which is C++'s own for these
// members.
#ifndef SHADEWRIGHT_RENDER_SHARED_H
#define SHADEWRIGHT_RENDER_SHARED_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
namespace shadewright::shared {
using glm::mat2;
using glm::mat3;
using glm::mat4;
using glm::mat4x3;
using glm::uvec2;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = uint32_t;
#endif

/// One placing of a mesh.
struct InstanceData {
  mat4x3 world_from_mesh;
  uint albedo;  // RGBA8, linear
  uint kind;    // render::InstanceFilter: unmoving or moving
};

/// A cluster of one instance that a view draws, as instance-rate vertex attributes: reading the instance from a storage
/// buffer in the vertex shader made a shadow map a fifth slower on a CPU device.
struct VisibleInstance {
  vec4 world_from_mesh_rows[3];
  uint albedo;
  uint first_triangle;  // of the cluster, into the triangle normals; and the bits of its body
  uint part;            // of what is drawn into, where that has parts: culling writes 0
  uint first_listed;    // of its triangles in a list of all of the view's, a multiple of listed_alignment
};

// In VisibleInstance::first_triangle: the cluster bounds closed bodies, and the instance turns its triangles' winding.
const uint body_closed = 0x80000000u, body_mirrored = 0x40000000u, first_triangle_mask = 0x3fffffffu;

/// What lies across an edge where no triangle, or more than one, does.
const uint no_vertex = 0xffffffffu;
/// Among packed normals, which never hold these: of an edge across which there is no vertex, and of what has no area.
const uint open_edge = 0x80008000u, no_normal = 0x80000000u;

/// A few hundred neighbouring triangles of a mesh with their box in mesh space, and which instances show them.
struct ClusterData {
  vec3 center;
  vec3 half_extent;
  uint first_index;  // into the index buffer
  uint index_count;
  uint first_instance;  // instances of one mesh lie side by side
  uint instance_count;
  uint list_base;      // where this cluster's visible instances are listed
  uint body;           // body_closed or 0
  float longest_edge;  // of its triangles, mesh space
  uint first_listed;   // of its first visible instance; the others' follow, aligned
};
/// Instances' triangles begin at multiples of this in lists of a view's triangles, so that a word holds bits of one
/// only.
const uint listed_alignment = 8;

/// A caster's view has five half-spaces of the light and, with the light in sight, six of a camera with a far plane.
const uint max_cull_planes = 12;

/// What one view draws: clusters inside all planes (world space, inside is positive), of instances of the `kinds`.
struct CullView {
  vec4 planes[max_cull_planes];
  uint plane_count;
  uint kinds;  // render::InstanceFilter
};

/// VkDrawIndexedIndirectCommand.
struct DrawCommand {
  uint index_count;
  uint instance_count;
  uint first_index;
  int vertex_offset;
  uint first_instance;
};

struct CullConstants {
  uint cluster_count;
  uint list_capacity;  // per view
};

/// A camera as the shaders need it. Positions relative to the eye keep float precise far from the origin.
struct CameraData {
  mat4 clip_from_relative;  // clip from (world - eye)
  mat3 ray_from_ndc;        // (ndc.x, ndc.y, 1) to the world direction whose view depth is 1
  vec3 eye;
  float depth_scale;  // depth = depth_scale + depth_offset / view_depth, whatever the convention
  float depth_offset;
  float background_depth;  // what the depth buffer holds where nothing was drawn
  uvec2 size;
};

#ifdef __cplusplus
}  // namespace shadewright::shared
#endif
#endif
