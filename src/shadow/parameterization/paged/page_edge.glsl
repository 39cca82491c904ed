// refine=edges (ASM, algorithm 1, step 6): a pixel asks for the pages of its own level only where the coarser one that answers it now
// shows a shadow's edge: where the texels around it do not agree.
#include "shadow/storage/depth/depth.glsl"

bool on_edge(MapPoint p) {
  vec2 center = (floor(p.uv / p.texel) + 0.5) * p.texel;
  int lit = 0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      MapPoint tap = map_tap(p, center + vec2(x, y) * p.texel);
      lit += storage_visible(tap) > 0.5 ? 1 : 0;
    }
  return lit > 0 && lit < 9;
}

bool asks_for_finer(vec3 world, vec4 plane, uint level, out MapPoint p) {
  p = map_point_at(world, plane, level);
  return p.valid && point_level(p) > level && on_edge(p);
}
