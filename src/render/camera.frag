// Camera pass: the triangle's own geometric normal (never interpolated, never from screen derivatives), towards the camera.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "render/octahedral.glsl"

layout(location = 0) flat in uint first_triangle;
layout(location = 1) flat in mat3 normal_from_mesh;
layout(location = 0) out vec2 normal_octahedral;
#ifdef WITH_ALBEDO
layout(location = 4) flat in vec4 albedo;
layout(location = 1) out vec4 albedo_out;
#endif

layout(binding = 0, scalar) readonly buffer Normals { uint triangle_normals[]; };  // mesh space, octahedral, 2 x snorm16

void main() {
  vec3 normal_mesh = octahedral_decode(unpackSnorm2x16(triangle_normals[first_triangle + gl_PrimitiveID]));
  vec3 normal = normalize(normal_from_mesh * normal_mesh);
  normal_octahedral = octahedral_encode(gl_FrontFacing ? normal : -normal);
#ifdef WITH_ALBEDO
  albedo_out = albedo;
#endif
}
