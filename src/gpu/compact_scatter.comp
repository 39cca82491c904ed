// Each value that stays goes to its place.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer Values { uint values[]; };
layout(binding = 1, scalar) readonly buffer Places { uint places[]; };
layout(binding = 2, scalar) writeonly buffer Compact { uint compact[]; };
layout(push_constant) uniform Push { uint count; };

void main() {
  for (uint k = 0; k < 4; ++k) {
    uint i = (gl_WorkGroupID.x * 4 + k) * 64 + gl_LocalInvocationIndex;
    if (i < count && values[i] != ~0u) compact[places[i]] = values[i];
  }
}
