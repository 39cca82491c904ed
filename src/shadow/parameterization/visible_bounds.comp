// Bounds of the frame's surface points, in sets by view depth, each in a light frame's coordinates (see LightFrame).
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "render/camera.glsl"
#include "shadow/parameterization/visible_bounds_shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform Camera { CameraData camera; };
layout(binding = 1) uniform sampler2D camera_depth;
layout(binding = 2, scalar) readonly buffer Sets { BoundedSet sets[]; };
layout(binding = 3, scalar) buffer Bounds { OrderedBounds bounds[]; };
layout(push_constant, scalar) uniform Push { uint set_count; };

shared uint low[3 * max_bounded_sets], high[3 * max_bounded_sets];

// Unsigned integers in the order of the floats.
uint ordered(float x) {
  uint bits = floatBitsToUint(x);
  return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

void main() {
  uint local = gl_LocalInvocationIndex;
  if (local < 3 * set_count) {
    low[local] = ~0u;
    high[local] = 0u;
  }
  barrier();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  bool seen = all(lessThan(pixel, ivec2(camera.size)));
  float depth = seen ? texelFetch(camera_depth, pixel, 0).r : camera.background_depth;
  if (depth != camera.background_depth) {
    float view_depth = camera_view_depth(camera, depth);
    vec4 world = vec4(camera_surface(camera, pixel, depth), 1.0);
    for (uint i = 0; i < set_count; ++i) {
      if (view_depth < sets[i].nearest || view_depth > sets[i].farthest) continue;
      vec3 p = sets[i].view_from_world * world;
      if (sets[i].max_tangent > 0.0) {
        if (p.z >= 0.0 || any(greaterThan(abs(p.xy), vec2(-p.z * sets[i].max_tangent)))) continue;
        p.xy /= -p.z;
      }
      // Few points move a bound: reading first spares the rest an atomic.
      for (uint axis = 0; axis < 3; ++axis) {
        uint value = ordered(p[axis]), slot = 3 * i + axis;
        if (value < low[slot]) atomicMin(low[slot], value);
        if (value > high[slot]) atomicMax(high[slot], value);
      }
    }
  }
  barrier();
  if (local < 3 * set_count) {
    if (low[local] < bounds[local / 3].low[local % 3]) atomicMin(bounds[local / 3].low[local % 3], low[local]);
    if (high[local] > bounds[local / 3].high[local % 3]) atomicMax(bounds[local / 3].high[local % 3], high[local]);
  }
}
