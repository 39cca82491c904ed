// Copies sorted values, with those that repeat their predecessor replaced by ~0.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer Values { uint values[]; };
layout(binding = 1, scalar) writeonly buffer Marked { uint marked[]; };
layout(push_constant) uniform Push { uint count; };

void main() {
  for (uint k = 0; k < 4; ++k) {
    uint i = (gl_WorkGroupID.x * 4 + k) * 64 + gl_LocalInvocationIndex;
    if (i < count) marked[i] = i > 0 && values[i] == values[i - 1] ? ~0u : values[i];
  }
}
