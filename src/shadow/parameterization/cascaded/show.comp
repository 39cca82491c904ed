// Debug picture "cascades": which cascade each receiver takes; max_cascades where none holds it, one more where there is none.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/cascaded/cascaded.glsl"
#include "shadow/receivers.glsl"
#include "shadow/receiver_strip.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 3, scalar) writeonly buffer Chosen { uint chosen[]; };

void main() {
  ivec2 pixel = strip_pixel(ivec2(gl_GlobalInvocationID.xy));
  if (any(greaterThanEqual(pixel, ivec2(camera.size)))) return;
  Receiver r = receiver_at(pixel);
  CascadeWindow window;
  uint cascade = cascade_of(cascades.light_from_world * vec4(r.world, 1.0), window);
  chosen[strip_index(pixel)] = r.background ? max_cascades + 1 : cascade;
}
