// requests=sort: marks the pages of the list, and those that hold them, as requests=bits does at once. A list that was not compacted
// has gaps (~0), one that was not made unique has repetitions.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/shared.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) uniform Paged { PagedConstants paged; };
layout(binding = 1, scalar) readonly buffer List { uint list[]; };
layout(binding = 2, scalar) buffer Requested { uint requested[]; };
layout(binding = 3, scalar) buffer RequestedOrFiner { uint requested_or_finer[]; };
layout(push_constant, scalar) uniform Push {
  uint count;
  uint row_of_groups;
};

#include "shadow/parameterization/paged/pages.glsl"

void main() {
  uint place = gl_GlobalInvocationID.y * row_of_groups * 64u + gl_GlobalInvocationID.x;
  if (place >= count || list[place] == ~0u) return;
  uint index = list[place], word = index >> 5, bit = 1u << (index & 31u), first = word / paged.words * paged.words * 32u;
  if ((requested[word] & bit) != 0 || (atomicOr(requested[word], bit) & bit) != 0) return;
  uint level = word_level(word % paged.words), number = index - first - page_base(paged.top - level);
  for (; level <= paged.top; ++level, number >>= 2) {
    uint above = first + page_base(paged.top - level) + number;
    bit = 1u << (above & 31u);
    if ((atomicOr(requested_or_finer[above >> 5], bit) & bit) != 0) return;
  }
}
