// Backward analysis without an importance map (the paper's steps (a) and (b.i) in one): the camera's pixels that can receive a
// shadow raise the maximum, and add to the sum, of their row and of their column. One invocation a tile of 4 x 4 pixels.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#define SHADEWRIGHT_LOADS_FIRST 1
#include "shadow/map_point.glsl"
#include "shadow/receivers.glsl"
#include "shadow/parameterization/rectilinear/shared.h"
#include "shadow/parameterization/rectilinear/known.glsl"
#include "shadow/parameterization/rectilinear/importance.glsl"
#include "shadow/parameterization/rectilinear/accumulate.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 5, scalar) readonly buffer Edges { uint edges[]; };

const int tile = 4;

shared uint low_inverted[2], high[2];

void sample_pixel(ivec2 pixel, Orientation o, bool add) {
  Receiver r = receiver_at(pixel);
  if (!r.facing) return;
  vec4 q = map_first_view.map_from_world * vec4(r.world, 1.0);
  vec3 map = q.xyz / q.w;
  vec2 value = importance(camera, camera_view_depth(camera, texelFetch(camera_depth, pixel, 0).r), r, map, o, constants);
  if ((functions & importance_edges) != 0) {
    uvec2 texel = min(uvec2(clamp(map.xy, 0.0, 1.0) * float(constants.image_size)), constants.image_size - 1);
    value *= edges[texel.y * constants.image_size + texel.x] != 0 ? 1.0 : constants.flat_weight;
  }
  accumulate(pixel, whole_of(o, map.xy), value, add);
}

void main() {
  if (gl_LocalInvocationIndex < 2) low_inverted[gl_LocalInvocationIndex] = high[gl_LocalInvocationIndex] = 0;
  barrier();
  load_lookup();
  load_camera();
  ivec2 first = ivec2(gl_GlobalInvocationID.xy) * tile, size = ivec2(camera.size);
  Orientation o = chosen_orientation();
  vec2 depths = vec2(1.0 / 0.0, -1.0 / 0.0);  // least, greatest
  for (int i = 0; i < tile; i += 2)
    for (int j = 0; j < tile; j += 2) {
      vec4 depth = textureGather(camera_depth, vec2(min(first + ivec2(i, j) + 1, size - 1)) / vec2(size));
      bvec4 seen = notEqual(depth, vec4(camera.background_depth));
      vec4 low = mix(vec4(1.0 / 0.0), depth, seen), high = mix(vec4(-1.0 / 0.0), depth, seen);
      depths.x = min(depths.x, min(min(low.x, low.y), min(low.z, low.w)));
      depths.y = max(depths.y, max(max(high.x, high.y), max(high.z, high.w)));
    }
  bool seen = depths.x <= depths.y && all(lessThan(first, size));
  if (seen && (collapse == collapse_max || two_dimensional))
    for (int i = 0; i < tile * tile; ++i) sample_pixel(min(first + ivec2(i % tile, i / tile), size - 1), o, false);
  if (seen) {
    sample_pixel(min(first + tile / 2, size - 1), o, true);
    // All of the tile's receivers lie between its rays and its depths.
    vec2 low = vec2(1.0), high_here = vec2(0.0);
    float nearest = camera_view_depth(camera, depths.x), farthest = camera_view_depth(camera, depths.y);
    for (int i = 0; i < 8; ++i) {
      vec3 ray = camera_ray(camera, vec2(first + ivec2(i & 1, (i >> 1) & 1) * tile));
      vec4 q = map_first_view.map_from_world * vec4(camera.eye + ray * (i < 4 ? nearest : farthest), 1.0);
      vec2 whole = whole_of(o, q.xy / q.w);
      low = q.w > 0.0 ? min(low, whole) : vec2(0.0);
      high_here = q.w > 0.0 ? max(high_here, whole) : vec2(1.0);
    }
    for (int axis = 0; axis < 2; ++axis) {
      atomicMax(low_inverted[axis], ~floatBitsToUint(low[axis]));
      atomicMax(high[axis], floatBitsToUint(high_here[axis]));
    }
  }
  barrier();
  if (gl_LocalInvocationIndex < 2 && low_inverted[gl_LocalInvocationIndex] != 0) {
    atomicMax(accumulated.low_inverted[gl_LocalInvocationIndex], low_inverted[gl_LocalInvocationIndex]);
    atomicMax(accumulated.high[gl_LocalInvocationIndex], high[gl_LocalInvocationIndex]);
  }
}
