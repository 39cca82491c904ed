// The least a shadow map costs: world-space triangles through one matrix.
#version 460
#extension GL_EXT_scalar_block_layout : require
layout(location = 0) in vec3 world;
layout(push_constant, scalar) uniform Push { mat4 clip_from_world; };
void main() { gl_Position = clip_from_world * vec4(world, 1.0); }
