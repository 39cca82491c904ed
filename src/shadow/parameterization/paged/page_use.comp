// The picture of the page table (RMSM, figure 14): a pixel a page, level 0 to the left and the coarser ones beside it, downwards;
// faces below each other. Green: not in the pool; black to white: how many of its texels the look-up reads.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Used { uint used[]; };  // see page_statistics.comp
layout(set = 0, binding = 1, scalar) writeonly buffer Picture { uint picture[]; };

void main() {
  uint word = gl_GlobalInvocationID.x;
  if (word >= paged.words * paged.faces) return;
  uint face = word / paged.words, level = word_level(word % paged.words), side = 1u << paged.top, own = side >> level;
  uvec2 corner = level == 0 ? uvec2(0) : uvec2(side, side - (side >> (level - 1)));
  for (uint bit = 0; bit < 32u; ++bit) {
    uint number = (word % paged.words) * 32u + bit - page_base(paged.top - level);
    if (number >= own * own) break;
    uint entry = page_table[word * 32u + bit];
    vec3 color = vec3(0.1, 0.6, 0.1);
    if (is_current(entry)) {
      uint texels = 0;
      uvec2 first = place_page(entry_place(entry)) * uvec2(1, page_texels);
      for (uint row = 0; row < page_texels; ++row) texels += bitCount(used[(first.y + row) * paged.pool_width + first.x]);
      color = vec3(float(texels) / float(page_texels * page_texels));
    }
    uvec2 place = corner + z_curve_place(number);
    picture[(face * side + place.y) * (side + side / 2) + place.x] = packUnorm4x8(vec4(color, 1.0));
  }
}
