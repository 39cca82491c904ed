// Camera pass: positions relative to the eye, and where the draw's triangles begin.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "render/shared.h"

layout(location = 0) in vec3 position_mesh;
layout(location = 0) flat out uint instance_index;
layout(location = 1) flat out uint first_triangle;
layout(location = 2) out vec3 relative;

layout(binding = 0, scalar) readonly buffer Instances { InstanceData instances[]; };
layout(binding = 1, scalar) readonly buffer Visible { uint visible[]; };
layout(binding = 2, scalar) readonly buffer Draws { DrawCommand draws[]; };
layout(binding = 4, scalar) uniform Camera { CameraData camera; };

void main() {
  instance_index = visible[gl_InstanceIndex];
  first_triangle = draws[gl_DrawID].first_index / 3;
  relative = instances[instance_index].world_from_mesh * vec4(position_mesh, 1.0) - camera.eye;
  gl_Position = camera.clip_from_relative * vec4(relative, 1.0);
}
