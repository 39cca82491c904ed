// The pages that the frame needs: those requested, and in place of levels that were dropped the finest that is left. How many
// of a word have no slot yet, and which must be drawn: those that do not hold what they should. Blocks of which enough is needed
// are needed and drawn whole.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/shared.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) uniform Paged { PagedConstants paged; };
layout(binding = 1, scalar) buffer Requested { uint requested[]; };
layout(binding = 2, scalar) readonly buffer RequestedOrFiner { uint requested_or_finer[]; };
layout(binding = 3, scalar) buffer Placed { uint placed[]; };  // pages with a slot
layout(binding = 4, scalar) buffer Valid { uint valid[]; };    // pages that hold the casters as they are
layout(binding = 5, scalar) buffer StateOut { PageState state; };
layout(binding = 6, scalar) writeonly buffer Draw { uint draw[]; };
layout(binding = 7, scalar) writeonly buffer Counts { uint counts[]; };  // of new blocks and pages, see new_count
layout(binding = 8, scalar) readonly buffer Table { uint table[]; };

#include "shadow/parameterization/paged/pages.glsl"

void main() {
  uint word = gl_GlobalInvocationID.x;
  if (word >= paged.words * paged.faces) return;
  uint level = word_level(word % paged.words), needed = requested[word];
  if (level == state.finest && level > paged.finest) needed = requested_or_finer[word];
  if (level < state.finest) needed = 0;
  if (state.flushed != 0) placed[word] = valid[word] = 0;
  bool whole = has_blocks(level), new_block = whole && placed[word] == 0 && bitCount(needed) >= state.block_least;
  if (new_block) needed = ~0u;
  uint entry = table[word * 32u], to_draw = needed & ~valid[word], singles = new_block ? 0 : bitCount(needed & ~placed[word]);
  if (to_draw != 0 && is_of(entry, state.epoch) && (entry & entry_block) != 0) to_draw = ~0u;
  requested[word] = needed;
  draw[word] = to_draw;
  counts[word] = new_count(new_block ? 1 : 0, singles);
  if (new_block) atomicAdd(state.new_blocks, 1);
  if (singles > 0) atomicAdd(state.new_singles, singles);
}
