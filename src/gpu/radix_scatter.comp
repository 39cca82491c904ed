// Moves each key behind those of smaller digits, of earlier blocks, and before it in its own: stable.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer Keys { uint keys[]; };
layout(binding = 1, scalar) readonly buffer Before { uint before[]; };
layout(binding = 2, scalar) writeonly buffer Sorted { uint sorted[]; };
layout(push_constant) uniform Push { uint count, shift; };

shared uint places[16][64];  // by digit, by invocation

void main() {
  uint own = gl_LocalInvocationIndex;
  for (uint digit = 0; digit < 16; ++digit) places[digit][own] = 0;
  uint first = gl_WorkGroupID.x * 1024 + own * 16, end = min(first + 16, count);
  for (uint i = first; i < end; ++i) ++places[keys[i] >> shift & 15u][own];
  barrier();
  if (own < 16) {
    uint place = before[own * gl_NumWorkGroups.x + gl_WorkGroupID.x];
    for (uint i = 0; i < 64; ++i) {
      uint number = places[own][i];
      places[own][i] = place;
      place += number;
    }
  }
  barrier();
  for (uint i = first; i < end; ++i) sorted[places[keys[i] >> shift & 15u][own]++] = keys[i];
}
