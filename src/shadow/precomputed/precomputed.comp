// Visibility of each camera pixel from the voxel DAG, and the least of it and what moving casters leave lit.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_GOOGLE_include_directive : require
#define SHADEWRIGHT_LOADS_FIRST 1
#include "shadow/precomputed/precomputed.glsl"
#include "shadow/receivers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 3, r8) uniform writeonly image2D visibility;
layout(set = 0, binding = 4) uniform sampler2D moving_visibility;  // of casters that move; bound to depth where none do

const bool with_moving = (variant & 0x1000u) != 0u;

void main() {
  load_lookup();
  load_camera();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(camera.size)))) return;
  Receiver r = receiver_at(pixel);
  float visible = r.background ? 1.0 : 0.0;
  float left_lit = with_moving ? texelFetch(moving_visibility, pixel, 0).r : 1.0;
  if (r.facing && left_lit > 0.0) visible = min(left_lit, filter_visible(r.world, vec4(r.normal, -dot(r.normal, r.world))));
  imageStore(visibility, pixel, vec4(visible));
}
