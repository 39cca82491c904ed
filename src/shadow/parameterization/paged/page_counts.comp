// The pages that the frame needs: those requested, and in place of levels that were dropped the finest that is left. How many
// of a word have no slot yet, and which must be drawn: those that do not hold what they should.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/pages.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) uniform Paged { PagedConstants paged; };
layout(binding = 1, scalar) buffer Requested { uint requested[]; };
layout(binding = 2, scalar) readonly buffer RequestedOrFiner { uint requested_or_finer[]; };
layout(binding = 3, scalar) buffer Placed { uint placed[]; };  // pages with a slot
layout(binding = 4, scalar) buffer Valid { uint valid[]; };    // pages that hold the casters as they are
layout(binding = 5, scalar) readonly buffer State { PageState state; };
layout(binding = 6, scalar) writeonly buffer Draw { uint draw[]; };
layout(binding = 7, scalar) writeonly buffer Counts { uint counts[]; };

#include "shadow/parameterization/paged/pages.glsl"

void main() {
  uint word = gl_GlobalInvocationID.x;
  if (word >= paged.words * paged.faces) return;
  uint level = word_level(word % paged.words), needed = requested[word];
  if (level == state.finest && level > paged.finest) needed = requested_or_finer[word];
  if (level < state.finest) needed = 0;
  if (state.flushed != 0) placed[word] = valid[word] = 0;
  requested[word] = needed;
  draw[word] = needed & ~valid[word];
  counts[word] = bitCount(needed & ~placed[word]);
}
