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

const int pixels = 4;  // of an invocation, per axis

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
  ivec2 first = ivec2(gl_WorkGroupID.xy) * pixels * 8 + ivec2(gl_LocalInvocationID.xy);
  vec4 points[pixels * pixels];  // world, view depth; negative where nothing is seen
  for (int k = 0; k < pixels * pixels; ++k) {
    ivec2 pixel = first + 8 * ivec2(k % pixels, k / pixels);
    float depth = all(lessThan(pixel, ivec2(camera.size))) ? texelFetch(camera_depth, pixel, 0).r : camera.background_depth;
    bool seen = depth != camera.background_depth;
    points[k] = seen ? vec4(camera_surface(camera, pixel, depth), camera_view_depth(camera, depth)) : vec4(-1.0);
  }
  for (uint i = 0; i < set_count; ++i) {
    vec3 least = vec3(1.0 / 0.0), greatest = -least;
    for (int k = 0; k < pixels * pixels; ++k) {
      float view_depth = points[k].w;
      if (view_depth < max(sets[i].nearest, 0.0) || view_depth > sets[i].farthest) continue;
      vec3 p = sets[i].view_from_world * vec4(points[k].xyz, 1.0);
      if (sets[i].max_tangent > 0.0) {
        if (p.z >= 0.0 || any(greaterThan(abs(p.xy), vec2(-p.z * sets[i].max_tangent)))) continue;
        p.xy /= -p.z;
      }
      least = min(least, p);
      greatest = max(greatest, p);
    }
    if (least.x > greatest.x) continue;
    for (uint axis = 0; axis < 3; ++axis) {
      atomicMin(low[3 * i + axis], ordered(least[axis]));
      atomicMax(high[3 * i + axis], ordered(greatest[axis]));
    }
  }
  barrier();
  if (local < 3 * set_count) {
    if (low[local] < bounds[local / 3].low[local % 3]) atomicMin(bounds[local / 3].low[local % 3], low[local]);
    if (high[local] > bounds[local / 3].high[local % 3]) atomicMax(bounds[local / 3].high[local % 3], high[local]);
  }
}
