// statistics=on: how the filter's taps are answered (by the page they asked for, by a coarser one, by none), and which texels of
// the pool they read.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"
#include "shadow/receivers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 3, scalar) buffer StateOut { PageState state; };
layout(set = 0, binding = 4, scalar) buffer Used { uint used[]; };  // a bit a texel

shared uint taps, coarser_taps, lost_taps;

void count_tap(MapPoint p, uint level) {
  atomicAdd(taps, 1);
  ivec3 address;
  if (!p.valid || !map_fetch(p, ivec2(0), address)) {
    atomicAdd(lost_taps, 1);
    return;
  }
  if (point_level(p) > level) atomicAdd(coarser_taps, 1);
  uint word = uint(address.y) * paged.pool_width + uint(address.x) / 32u, bit = 1u << (uint(address.x) & 31u);
  if ((used[word] & bit) == 0 && (atomicOr(used[word], bit) & bit) == 0) atomicAdd(state.used_texels, 1);
}

void count_level(vec3 world, vec4 plane, uint level) {
  MapPoint p = map_point_at(world, plane, level);
  if (!p.valid) {
    count_tap(p, level);
    return;
  }
  vec2 first = floor(p.uv / p.texel - paged.footprint);
  int width = int(2.0 * paged.footprint) + 1;
  for (int k = 0; k < width * width; ++k) count_tap(map_tap(p, (first + vec2(k % width, k / width) + 0.5) * p.texel), level);
}

void main() {
  if (gl_LocalInvocationIndex == 0) taps = coarser_taps = lost_taps = 0;
  barrier();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(pixel, ivec2(camera.size)))) {
    Receiver r = receiver_at(pixel);
    if (r.facing) {
      vec4 plane = vec4(r.normal, -dot(r.normal, r.world));
      uint level = uint(map_level(r.world, plane));
      for (uint l = level; l < min(level + paged.footprint_levels, paged.coarsest + 1); ++l) count_level(r.world, plane, l);
    }
  }
  barrier();
  if (gl_LocalInvocationIndex > 0) return;
  atomicAdd(state.taps, taps);
  atomicAdd(state.coarser_taps, coarser_taps);
  atomicAdd(state.lost_taps, lost_taps);
}
