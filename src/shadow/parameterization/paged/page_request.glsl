// Marks pages as requested. Needs the masks `requested` and `requested_or_finer`.
void request(uint face, uint level, uvec2 page) {
  uint index = page_index(face, level, page);
  uint bit = 1u << (index & 31u);
  // Most pixels ask for what their neighbours asked for: a look is cheaper than an atomic.
  if ((requested[index >> 5] & bit) != 0) return;
  if ((atomicOr(requested[index >> 5], bit) & bit) != 0) return;
  for (; level <= paged.top; ++level, page >>= 1) {
    index = page_index(face, level, page);
    bit = 1u << (index & 31u);
    if ((atomicOr(requested_or_finer[index >> 5], bit) & bit) != 0) return;
  }
}

void request_level(MapPoint p, uint face, uint level) {
  float size = level_size(level);
  vec2 low = floor(p.uv * size - paged.footprint), high = floor(p.uv * size + paged.footprint);
  uvec2 last = uvec2(-1);
  for (int k = 0; k < (paged.footprint > 0.0 ? 4 : 1); ++k) {
    uvec2 page = uvec2(clamp(mix(low, high, vec2(k & 1, k >> 1)), vec2(0.0), vec2(size - 1.0))) / page_texels;
    if (page == last) continue;
    request(face, level, page);
    last = page;
  }
}
