// fit=visible: bounds of the frame's surface points in a light frame's coordinates (see LightFrame), per light frame.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "render/camera.glsl"
#include "shadow/parameterization/uniform/reduce.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform Camera { CameraData camera; };
layout(binding = 1) uniform sampler2D camera_depth;
layout(binding = 2, scalar) readonly buffer Axes { LightAxes axes[]; };
layout(binding = 3, scalar) buffer Bounds { OrderedBounds bounds[]; };

shared uint low[3], high[3];

// Unsigned integers in the order of the floats.
uint ordered(float x) {
  uint bits = floatBitsToUint(x);
  return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

void main() {
  uint face = gl_GlobalInvocationID.z;
  if (gl_LocalInvocationIndex < 3) {
    low[gl_LocalInvocationIndex] = ~0u;
    high[gl_LocalInvocationIndex] = 0u;
  }
  barrier();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(pixel, ivec2(camera.size)))) {
    float depth = texelFetch(camera_depth, pixel, 0).r;
    vec3 p = (axes[face].view_from_world * vec4(camera_surface(camera, pixel, depth), 1.0));
    bool counts = depth != camera.background_depth;
    if (axes[face].max_tangent > 0.0) {
      counts = counts && p.z < 0.0 && all(lessThanEqual(abs(p.xy), vec2(-p.z * axes[face].max_tangent)));
      p.xy /= -p.z;
    }
    if (counts)
      for (int axis = 0; axis < 3; ++axis) {
        atomicMin(low[axis], ordered(p[axis]));
        atomicMax(high[axis], ordered(p[axis]));
      }
  }
  barrier();
  if (gl_LocalInvocationIndex < 3) {
    uint axis = gl_LocalInvocationIndex;
    atomicMin(bounds[face].low[axis], low[axis]);
    atomicMax(bounds[face].high[axis], high[axis]);
  }
}
