// Gives each new page its slot in the pool: the number of new pages before it. Notes which pages hold one to draw, and the
// quads that empty those.
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
layout(set = 0, binding = 8, scalar) writeonly buffer ClearQuads { PageVertex clear_quads[]; };

void empty_page(uint slot) {
  uint first = atomicAdd(state.clear_vertex_count, 6);
  vec2 place = vec2(slot % paged.pool_width, slot / paged.pool_width);
  const uint corners[6] = uint[6](0, 1, 2, 2, 1, 3);
  for (int k = 0; k < 6; ++k) {
    vec2 corner = (place + vec2(corners[k] & 1, corners[k] >> 1)) * (2.0 / float(paged.pool_width)) - 1.0;
    clear_quads[first + k] = PageVertex(vec3(corner, 1.0), slot);
  }
}

void main() {
  uint word = gl_GlobalInvocationID.x;
  if (word >= paged.words * paged.faces || requested[word] == 0) return;
  uint first = word / paged.words * paged.words * 32u, level = word_level(word % paged.words);
  uint slot = page_state.first_slot + before[word], fresh = requested[word] & ~placed[word];
  for (uint bits = fresh; bits != 0; bits &= bits - 1) table[word * 32u + uint(findLSB(bits))] = page_entry(slot++, level);
  placed[word] |= fresh;
  valid[word] |= requested[word];
  if (draw[word] != 0) atomicAdd(state.pages_drawn, bitCount(draw[word]));
  for (uint bits = draw[word]; bits != 0; bits &= bits - 1) {
    uint index = word * 32u + uint(findLSB(bits));
    empty_page(entry_slot(table[index]));
    uint number = index - first - page_base(paged.top - level);
    for (uint l = level; l <= paged.top; ++l, number >>= 2) {
      uint above = first + page_base(paged.top - l) + number, bit = 1u << (above & 31u);
      if ((atomicOr(draw_or_finer[above >> 5], bit) & bit) != 0) break;
    }
  }
}
