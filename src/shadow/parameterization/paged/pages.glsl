// Where a page of the virtual map stands in bitmasks and tables. A level's pages are numbered along the Z curve, coarsest level
// first, so that a page's four children follow each other, 32 pages of one word are a block of 8 x 4, and the 1,024 pages of a
// superpage are neighbours. Needs `paged`, the PagedConstants.
#ifndef SHADEWRIGHT_PAGES_GLSL
#define SHADEWRIGHT_PAGES_GLSL

#include "shadow/parameterization/paged/pages.h"

// Every second bit of x.
uint z_curve_spread(uint x) {
  x = (x | x << 8) & 0x00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0fu;
  x = (x | x << 2) & 0x33333333u;
  return (x | x << 1) & 0x55555555u;
}
uint z_curve_gather(uint x) {
  x &= 0x55555555u;
  x = (x | x >> 1) & 0x33333333u;
  x = (x | x >> 2) & 0x0f0f0f0fu;
  x = (x | x >> 4) & 0x00ff00ffu;
  return (x | x >> 8) & 0x0000ffffu;
}
uint z_curve(uvec2 page) { return z_curve_spread(page.x) | z_curve_spread(page.y) << 1; }
uvec2 z_curve_place(uint index) { return uvec2(z_curve_gather(index), z_curve_gather(index >> 1)); }

// Number of the first page of the level with 4^k pages. Levels of less than 32 pages have a word each, so that no word has pages
// of two levels.
uint page_base(uint k) { return k < 3u ? 32u * k : 96u + ((1u << 2u * k) - 64u) / 3u; }

uint page_index(uint face, uint level, uvec2 page) {
  return face * paged.words * 32u + page_base(paged.top - level) + z_curve(page);
}

// The level of the pages in a word of one face.
uint word_level(uint word) {
  uint k = 0;
  while (page_base(k + 1) <= word * 32u) ++k;
  return paged.top - k;
}

#endif
