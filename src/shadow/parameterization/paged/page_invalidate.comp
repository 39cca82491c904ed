// Pages that a changed caster's bounds touch no longer hold the casters as they are. One work group a box, level and face.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Boxes { ChangedBox boxes[]; };
layout(set = 0, binding = 1, scalar) buffer Valid { uint valid[]; };

void main() {
  ChangedBox box = boxes[gl_WorkGroupID.x];
  uint level = gl_WorkGroupID.y, face = gl_WorkGroupID.z;
  vec2 low = vec2(1e30), high = vec2(-1e30);
  bool behind = false, before = false;
  for (int corner = 0; corner < 8; ++corner) {
    vec3 world = mix(box.low, box.high, vec3(corner & 1, corner >> 1 & 1, corner >> 2));
    vec4 q = map_views[face].map_from_world * vec4(world, 1.0);
    behind = behind || q.w < paged.near[face];
    before = before || q.w >= paged.near[face];
    if (q.w < paged.near[face]) continue;
    low = min(low, q.xy / q.w);
    high = max(high, q.xy / q.w);
  }
  if (!before) return;
  if (behind) {
    low = vec2(0.0);
    high = vec2(1.0);
  }
  if (any(lessThan(high, vec2(0.0))) || any(greaterThan(low, vec2(1.0)))) return;
  float size = level_size(level);
  uvec2 a = uvec2(clamp(low * size - 1.0, vec2(0.0), vec2(size - 1.0))) / page_texels;
  uvec2 b = uvec2(clamp(high * size + 1.0, vec2(0.0), vec2(size - 1.0))) / page_texels;
  uvec2 block_a = a / uvec2(8, 4), blocks = b / uvec2(8, 4) - block_a + 1u;
  for (uint i = gl_LocalInvocationIndex; i < blocks.x * blocks.y; i += 64) {
    uvec2 first = (block_a + uvec2(i % blocks.x, i / blocks.x)) * uvec2(8, 4);
    uint word = page_index(face, level, first) >> 5, touched = 0;
    for (uint bit = 0; bit < 32; ++bit) {
      uvec2 page = first + z_curve_place(bit);
      if (all(greaterThanEqual(page, a)) && all(lessThanEqual(page, b))) touched |= 1u << bit;
    }
    if ((valid[word] & touched) != 0) atomicAnd(valid[word], ~touched);
  }
}
