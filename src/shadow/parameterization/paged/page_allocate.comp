// Gives each new block and page its slots in the pool: by the number of new ones before it. Notes which pages hold one to draw, and
// which units are emptied for it.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Requested { uint requested[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Draw { uint draw[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Before { uint before[]; };
layout(set = 0, binding = 3, scalar) buffer Placed { uint placed[]; };
layout(set = 0, binding = 4, scalar) buffer Valid { uint valid[]; };
layout(set = 0, binding = 5, scalar) buffer DrawOrFiner { uint draw_or_finer[]; };
layout(set = 0, binding = 6, scalar) buffer TableOut { uint table[]; };
layout(set = 0, binding = 7, scalar) buffer StateOut { PageState state; };
layout(set = 0, binding = 8, scalar) writeonly buffer Emptied { uint emptied[]; };

void empty(uint unit) { emptied[atomicAdd(state.clear.vertex_count, 6) / 6] = unit; }

void main() {
  uint word = gl_GlobalInvocationID.x;
  // The first block stands on a whole block's place.
  uint blocks = page_state.new_blocks, base = blocks > 0 ? (page_state.first_slot + block_pages - 1) / block_pages * block_pages
                                                         : page_state.first_slot;
  uint first_single = base + blocks * block_pages;
  if (word == 0) state.slots = first_single + page_state.new_singles;
  if (word >= paged.words * paged.faces || requested[word] == 0) return;
  uint level = word_level(word % paged.words), fresh = requested[word] & ~placed[word];
  bool new_block = has_blocks(level) && fresh == ~0u && page_state.block_least <= block_pages;
  uint slot = new_block ? base + (before[word] >> 20) * block_pages : first_single + (before[word] & 0xfffffu);
  uint entry = page_entry(0, level, page_state.epoch) | (new_block ? entry_block : 0);
  for (uint bits = fresh; bits != 0; bits &= bits - 1) table[word * 32u + uint(findLSB(bits))] = entry | slot_place(slot++);
  placed[word] |= fresh;
  valid[word] |= requested[word] | draw[word];
  if (draw[word] == 0) return;
  atomicAdd(state.pages_drawn, bitCount(draw[word]));
  uint first_entry = table[word * 32u];
  bool block = draw[word] == ~0u && is_current(first_entry) && (first_entry & entry_block) != 0;
  if (block) empty(entry_place(first_entry) | unit_block);
  uint first = word / paged.words * paged.words * 32u;
  for (uint bits = draw[word]; bits != 0; bits &= bits - 1) {
    uint index = word * 32u + uint(findLSB(bits));
    if (!block) empty(entry_place(table[index]));
    uint number = index - first - page_base(paged.top - level);
    for (uint l = level; l <= paged.top; ++l, number >>= 2) {
      uint above = first + page_base(paged.top - l) + number, bit = 1u << (above & 31u);
      if ((atomicOr(draw_or_finer[above >> 5], bit) & bit) != 0) break;
    }
  }
}
