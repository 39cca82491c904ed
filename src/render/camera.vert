// Camera pass: positions relative to the eye, and what the fragment shader needs for the triangle's own normal.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "render/scene_vertex.glsl"
#include "render/shared.h"

layout(location = 0) flat out uint first_triangle;
layout(location = 1) flat out mat3 normal_from_mesh;
#ifdef WITH_ALBEDO
layout(location = 4) flat out vec4 albedo;
#endif

layout(binding = 1, scalar) uniform Camera { CameraData camera; };

void main() {
  first_triangle = cluster_first_triangle & first_triangle_mask;
  // The cofactors of the linear part map cross products of edges, so the winding is that of the triangle in the world.
  vec3 x = world_from_mesh_row_x.xyz, y = world_from_mesh_row_y.xyz, z = world_from_mesh_row_z.xyz;
  normal_from_mesh = transpose(mat3(cross(y, z), cross(z, x), cross(x, y)));
#ifdef WITH_ALBEDO
  albedo = instance_albedo;
#endif
  gl_Position = camera.clip_from_relative * vec4(scene_world_position() - camera.eye, 1.0);
}
