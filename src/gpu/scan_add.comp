// Adds to each number what stands before its block.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(binding = 0, scalar) buffer Values { uint values[]; };
layout(binding = 1, scalar) readonly buffer Totals { uint totals[]; };
layout(push_constant) uniform Push { uint count; };

void main() {
  uint before = totals[gl_WorkGroupID.x];
  for (uint i = gl_LocalInvocationIndex; i < 1024; i += 64) {
    uint at = gl_WorkGroupID.x * 1024 + i;
    if (at < count) values[at] += before;
  }
}
