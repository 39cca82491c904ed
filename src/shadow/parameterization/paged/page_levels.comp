// Counts by level the pages that are requested, those that hold a requested one, and those of both that have no slot yet.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/shared.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) uniform Paged { PagedConstants paged; };
layout(binding = 1, scalar) readonly buffer Requested { uint requested[]; };
layout(binding = 2, scalar) readonly buffer RequestedOrFiner { uint requested_or_finer[]; };
layout(binding = 3, scalar) readonly buffer Placed { uint placed[]; };
layout(binding = 4, scalar) buffer StateOut { PageState state; };

#include "shadow/parameterization/paged/pages.glsl"

void main() {
  uint word = gl_GlobalInvocationID.x;
  if (word >= paged.words * paged.faces || requested_or_finer[word] == 0) return;
  uint level = word_level(word % paged.words), taken = paged.flush != 0 ? 0 : placed[word];
  atomicAdd(state.requested[level], bitCount(requested[word]));
  atomicAdd(state.requested_or_finer[level], bitCount(requested_or_finer[word]));
  atomicAdd(state.fresh[level], bitCount(requested[word] & ~taken));
  if (requested[word] != 0 && taken == 0 && has_blocks(level)) atomicAdd(state.blocks_with[bitCount(requested[word])], 1);
  atomicAdd(state.fresh_or_finer[level], bitCount(requested_or_finer[word] & ~taken));
}
