// Replaces each block of 1,024 numbers by its exclusive sums and tells the block's total.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "gpu/group_scan.glsl"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) buffer Values { uint values[]; };
layout(binding = 1, scalar) writeonly buffer Totals { uint totals[]; };
layout(push_constant) uniform Push { uint count; };

void main() {
  const uint own = 16;
  uint first = gl_WorkGroupID.x * 1024 + gl_LocalInvocationIndex * own;
  uint sum = 0, total;
  for (uint i = first; i < min(first + own, count); ++i) sum += values[i];
  uint before = group_exclusive_sum(sum, total);
  for (uint i = first; i < min(first + own, count); ++i) {
    uint value = values[i];
    values[i] = before;
    before += value;
  }
  if (gl_LocalInvocationIndex == 0) totals[gl_WorkGroupID.x] = total;
}
