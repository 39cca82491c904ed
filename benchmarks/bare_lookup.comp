// The least a look-up costs: a surface point from depth, one matrix, one tap, a constant bias.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "render/camera.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform Camera { CameraData camera; };
layout(binding = 1) uniform sampler2D camera_depth;
layout(binding = 2) uniform sampler2D shadow_map;
layout(binding = 3, r8) uniform writeonly image2D visibility;
layout(push_constant, scalar) uniform Push { mat4 clip_from_world; };

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(camera.size)))) return;
  vec4 q = clip_from_world * vec4(camera_surface(camera, pixel, texelFetch(camera_depth, pixel, 0).r), 1.0);
  ivec2 texel = ivec2((0.5 * q.xy + 0.5) * vec2(textureSize(shadow_map, 0)));
  imageStore(visibility, pixel, vec4(texelFetch(shadow_map, texel, 0).r < q.z - 0.001 ? 0.0 : 1.0));
}
