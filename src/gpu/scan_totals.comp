// Replaces the blocks' totals by their exclusive sums, the sum of all last. One work group.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "gpu/group_scan.glsl"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) buffer Totals { uint totals[]; };
layout(push_constant) uniform Push { uint count; };

void main() {
  uint blocks = (count + 1023) / 1024, carried = 0;
  for (uint base = 0; base < blocks; base += group_size) {
    uint i = base + gl_LocalInvocationIndex, total;
    uint value = i < blocks ? totals[i] : 0;
    uint before = group_exclusive_sum(value, total);
    if (i < blocks) totals[i] = carried + before;
    carried += total;
  }
  if (gl_LocalInvocationIndex == 0) totals[blocks] = carried;
}
