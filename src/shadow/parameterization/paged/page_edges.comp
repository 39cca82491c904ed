// refine=edges (ASM, algorithm 1): a pixel asks for the pages of its own level only where the coarser one that answers it now
// shows a shadow's edge: where the texels around it do not agree.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"
#include "shadow/storage/depth/depth.glsl"
#include "shadow/receivers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 3, scalar) buffer Requested { uint requested[]; };
layout(set = 0, binding = 4, scalar) buffer RequestedOrFiner { uint requested_or_finer[]; };
layout(set = 0, binding = 5, scalar) buffer StateOut { PageState state; };

#include "shadow/parameterization/paged/page_request.glsl"

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

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(camera.size)))) return;
  Receiver r = receiver_at(pixel);
  if (!r.facing) return;
  vec4 plane = vec4(r.normal, -dot(r.normal, r.world));
  uint level = uint(map_level(r.world, plane));
  MapPoint p = map_point_at(r.world, plane, level);
  if (!p.valid || point_level(p) <= level || !on_edge(p)) return;
  atomicAdd(state.raw_requests, 1);
  for (uint l = level; l < min(level + paged.footprint_levels, paged.coarsest + 1); ++l)
    request_level(p, point_face(p), l);
}
