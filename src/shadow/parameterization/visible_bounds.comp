// Bounds of the frame's surface points, in sets by view depth, each in a light frame's coordinates (see LightFrame).
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#define SHADEWRIGHT_LOADS_FIRST 1
#include "render/camera.glsl"
#include "shadow/loads_first.glsl"
#include "shadow/parameterization/visible_bounds_shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) SHADEWRIGHT_UNIFORM(CameraData, camera, load_camera)
layout(binding = 1) uniform sampler2D camera_depth;
#include "shadow/parameterization/camera_quad.glsl"
layout(binding = 2, scalar) readonly buffer Sets { BoundedSet sets[]; };
layout(binding = 3, scalar) buffer Bounds { OrderedBounds bounds[]; };
layout(push_constant, scalar) uniform Push { uint set_count; };

// Unsigned integers in the order of the floats.
uint ordered(float x) {
  uint bits = floatBitsToUint(x);
  return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

// Of the set at hand.
vec3 least, greatest;

void take(BoundedSet set, ivec2 pixel, float depth) {
  if (depth == camera.background_depth) return;
  float view_depth = camera_view_depth(camera, depth);
  if (view_depth < max(set.nearest, 0.0) || view_depth > set.farthest) return;
  vec3 p = set.view_from_world * vec4(camera_surface(camera, pixel, depth), 1.0);
  if (set.max_tangent > 0.0) {
    if (p.z >= 0.0 || any(greaterThan(abs(p.xy), vec2(-p.z * set.max_tangent)))) return;
    p.xy /= -p.z;
  }
  least = min(least, p);
  greatest = max(greatest, p);
}

// One invocation a tile of pixels: barriers cost a CPU device more than the pixels do.
void main() {
  load_camera();
  ivec2 first = ivec2(gl_GlobalInvocationID.xy) * bounded_tile, end = min(first + bounded_tile, ivec2(camera.size));
  for (uint i = 0; i < set_count; ++i) {
    BoundedSet set = sets[i];
    least = vec3(1.0 / 0.0);
    greatest = -least;
    for (int y = first.y; y < end.y; y += 2)
      for (int x = first.x; x < end.x; x += 2) {
        ivec2 quad = ivec2(x, y);
        vec4 depths = camera_quad(quad);
        for (int k = 0; k < 4; ++k) take(set, quad + quad_pixels[k], depths[k]);
      }
    if (least.x > greatest.x) continue;
    for (uint axis = 0; axis < 3; ++axis) {
      // Looking before: most tiles raise nothing.
      uint low = ordered(least[axis]), high = ordered(greatest[axis]);
      if (low < bounds[i].low[axis]) atomicMin(bounds[i].low[axis], low);
      if (high > bounds[i].high[axis]) atomicMax(bounds[i].high[axis], high);
    }
  }
}
