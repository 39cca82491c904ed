// Writes down what receivers the look-up sees, so that the CPU can be asked for the very same points.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 3, scalar) writeonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Normals { vec3 normals[]; };  // zero: does not face the light
layout(set = 0, binding = 5, scalar) uniform Lookup { LookupData lookup; };
uint light_kind() { return lookup.light_kind; }
#include "shadow/receivers.glsl"

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(camera.size)))) return;
  Receiver r = receiver_at(pixel);
  uint index = uint(pixel.y) * camera.size.x + uint(pixel.x);
  positions[index] = r.world;
  normals[index] = r.facing ? r.normal : vec3(0.0);
}
