// How many keys of each block of 1,024 have each value of a digit of four bits; digit by digit, block by block.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer Keys { uint keys[]; };
layout(binding = 1, scalar) writeonly buffer Counts { uint counts[]; };
layout(push_constant) uniform Push { uint count, shift; };

shared uint group_counts[16];

void main() {
  if (gl_LocalInvocationIndex < 16) group_counts[gl_LocalInvocationIndex] = 0;
  barrier();
  uint first = gl_WorkGroupID.x * 1024 + gl_LocalInvocationIndex * 16;
  for (uint i = first; i < min(first + 16, count); ++i) atomicAdd(group_counts[keys[i] >> shift & 15u], 1);
  barrier();
  if (gl_LocalInvocationIndex < 16)
    counts[gl_LocalInvocationIndex * gl_NumWorkGroups.x + gl_WorkGroupID.x] = group_counts[gl_LocalInvocationIndex];
}
