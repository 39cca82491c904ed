// The inverse of the warp where it is asked for: flat coordinates of each texel's edges and centre, and how large a texel is at
// most in each super-cell. One invocation a texel of an axis.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/rectilinear/shared.h"

layout(local_size_x = 64) in;
struct AtomicSegment { float flat_start, start, slope; uint half_texel_bits; };  // as WarpSegment
layout(binding = 0, scalar) buffer Warp { WarpData warp; AtomicSegment segments[]; };
layout(binding = 1, scalar) writeonly buffer Flats { float flats[]; };

// The segment that holds a warped coordinate.
uint segment_at(uint axis, float x) {
  uint low = 0, high = warp.header.segment_counts[axis] - 1;
  while (low < high) {
    uint middle = (low + high + 1) / 2;
    if (segments[axis * warp.header.cells + middle].start <= x) low = middle;
    else high = middle - 1;
  }
  return low;
}

float unwarp(uint axis, uint segment, float x) {
  AtomicSegment s = segments[axis * warp.header.cells + segment];
  return s.flat_start + (x - s.start) / s.slope;
}

void main() {
  uint texel = gl_GlobalInvocationID.x, axis = gl_GlobalInvocationID.y;
  if (texel >= warp.header.resolution) return;
  float low = float(texel) / float(warp.header.resolution), center = (float(texel) + 0.5) / float(warp.header.resolution),
        high = float(texel + 1) / float(warp.header.resolution);
  uint first = segment_at(axis, low), last = segment_at(axis, high);
  float flat_low = unwarp(axis, first, low), flat_center = unwarp(axis, segment_at(axis, center), center), flat_high = unwarp(axis, last, high);
  uint base = axis * (2 * warp.header.resolution + 1) + 2 * texel;
  flats[base] = flat_low;
  flats[base + 1] = flat_center;
  if (texel + 1 == warp.header.resolution) flats[base + 2] = flat_high;
  uint half_bits = floatBitsToUint(max(flat_center - flat_low, flat_high - flat_center));
  // Where a border of segments is one of texels, the texel ends there.
  if (last > first && segments[axis * warp.header.cells + last].start >= high) --last;
  for (uint segment = first; segment <= last; ++segment) atomicMax(segments[axis * warp.header.cells + segment].half_texel_bits, half_bits);
}
