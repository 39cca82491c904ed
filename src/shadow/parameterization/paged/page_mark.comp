// requests=sort: marks the pages of the unique list, and those that hold them, as requests=bits does at once.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/shared.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) uniform Paged { PagedConstants paged; };
layout(binding = 1, scalar) readonly buffer Unique { uint unique[]; };
layout(binding = 2, scalar) buffer Requested { uint requested[]; };
layout(binding = 3, scalar) buffer RequestedOrFiner { uint requested_or_finer[]; };
layout(push_constant, scalar) uniform Push { uint count; };

#include "shadow/parameterization/paged/pages.glsl"

void main() {
  if (gl_GlobalInvocationID.x >= count) return;
  uint index = unique[gl_GlobalInvocationID.x], word = index >> 5, first = word / paged.words * paged.words * 32u;
  atomicOr(requested[word], 1u << (index & 31u));
  uint level = word_level(word % paged.words), number = index - first - page_base(paged.top - level);
  for (; level <= paged.top; ++level, number >>= 2) {
    uint above = first + page_base(paged.top - level) + number, bit = 1u << (above & 31u);
    if ((atomicOr(requested_or_finer[above >> 5], bit) & bit) != 0) return;
  }
}
