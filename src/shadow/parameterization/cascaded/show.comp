// Debug picture "cascades": which cascade each receiver takes; `count` where none holds it, count + 1 where there is none.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/cascaded/cascaded.glsl"
#include "shadow/receivers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 3, scalar) writeonly buffer Chosen { uint chosen[]; };

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(camera.size)))) return;
  Receiver r = receiver_at(pixel);
  chosen[uint(pixel.y) * camera.size.x + uint(pixel.x)] = r.background ? cascades.count + 1 : cascade_of(r.world);
}
