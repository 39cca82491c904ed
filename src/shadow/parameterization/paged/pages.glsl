// Where a page of the virtual map stands in bitmasks and tables. A level's pages are numbered along the Z curve, coarsest level
// first, so that a page's four children follow each other, 32 pages of one word are a block of 8 x 4, and the 1,024 pages of a
// superpage are neighbours. Needs `paged`, the PagedConstants.
#ifndef SHADEWRIGHT_PAGES_GLSL
#define SHADEWRIGHT_PAGES_GLSL

#include "shadow/parameterization/paged/shared.h"

// Every second bit of x.
uint z_curve_spread(uint x) {
  x = (x | x << 8) & 0x00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0fu;
  x = (x | x << 2) & 0x33333333u;
  return (x | x << 1) & 0x55555555u;
}
uint z_curve(uvec2 page) { return z_curve_spread(page.x) | z_curve_spread(page.y) << 1; }

// Levels of less than 32 pages are no blocks.
bool has_blocks(uint level) { return paged.top - level >= 3; }

uint page_index(uint face, uint level, uvec2 page) {
  return face * paged.words * 32u + page_base(paged.top - level) + z_curve(page);
}

// Where a slot stands in the pool: blocks of slots along the Z curve, so that a block of pages can be one there too. A place is x and
// y in pages, 8 bits each. Dividing is dear, so that tables and pairs keep places.
const uint place_bits = 16;
uint slot_place(uint slot) {
  uint block = slot / block_pages, row = paged.pool_width / 8u;
  uvec2 place = uvec2(block % row * 8u, block / row * 4u) + z_curve_place(slot % block_pages);
  return place.x | place.y << 8;
}
uvec2 place_page(uint place) { return uvec2(place & 0xffu, place >> 8); }
vec2 place_texel(uint place) { return vec2(place_page(place) * page_texels); }

// An entry of the table: place, level, whether its block is one in the pool too, and the epoch in which it was written; entries of
// other epochs are void.
const uint entry_level_bits = 4, entry_block = 1u << 20, entry_epoch_shift = 21;
uint page_entry(uint place, uint level, uint epoch) { return place | level << place_bits | epoch << entry_epoch_shift; }
bool is_of(uint entry, uint epoch) { return entry >> entry_epoch_shift == epoch; }
uint entry_place(uint entry) { return entry & ((1u << place_bits) - 1u); }
uint entry_level(uint entry) { return entry >> place_bits & ((1u << entry_level_bits) - 1u); }

// New blocks and pages that are not in one, in one number for the scan.
uint new_count(uint blocks, uint singles) { return blocks << 20 | singles; }

// A (triangle, unit) pair: the number of the triangle and what is told of its side (4 bits), the unit and its first page in the
// virtual map.
uvec3 pack_pair(uint triangle, uint side, uint face, uint level, uvec2 page, uint place, bool block) {
  return uvec3(triangle | side << 28, place | (block ? unit_block : 0) | level << 17 | face << 21, page.x | page.y << 16);
}
uint pair_triangle(uvec3 pair) { return pair.x & 0xfffffffu; }
uint pair_side(uvec3 pair) { return pair.x >> 28; }
uint pair_place(uvec3 pair) { return pair.y & (unit_block - 1u); }
bool pair_is_block(uvec3 pair) { return (pair.y & unit_block) != 0; }
uint pair_level(uvec3 pair) { return pair.y >> 17 & 0xfu; }
uint pair_face(uvec3 pair) { return pair.y >> 21; }
uvec2 pair_page(uvec3 pair) { return uvec2(pair.z & 0xffffu, pair.z >> 16); }

// Bits of the pages of a block with x in [a, b], or y; coordinates within the block.
const uint block_upto_x[9] = uint[9](0x0u, 0x505u, 0xf0fu, 0x5f5fu, 0xffffu, 0x505ffffu, 0xf0fffffu, 0x5f5fffffu, 0xffffffffu);
const uint block_upto_y[5] = uint[5](0x0u, 0x330033u, 0xff00ffu, 0x33ff33ffu, 0xffffffffu);
uint block_mask(ivec2 a, ivec2 b) {
  return block_upto_x[b.x + 1] & ~block_upto_x[a.x] & block_upto_y[b.y + 1] & ~block_upto_y[a.y];
}

// The unit's texels in the pool: low, high.
vec4 pair_texels(uvec3 pair) {
  vec2 place = place_texel(pair_place(pair));
  return vec4(place, place + (pair_is_block(pair) ? vec2(256.0, 128.0) : vec2(page_texels)));
}

// The level of the pages in a word of one face.
uint word_level(uint word) {
  uint k = 0;
  while (page_base(k + 1) <= word * 32u) ++k;
  return paged.top - k;
}

#endif
