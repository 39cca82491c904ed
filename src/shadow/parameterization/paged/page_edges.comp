// refine=edges: marks the pages that pixels on the edges of coarse shadows ask for.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"
#include "shadow/parameterization/paged/page_edge.glsl"
#include "shadow/receivers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 3, scalar) buffer Requested { uint requested[]; };
layout(set = 0, binding = 4, scalar) buffer RequestedOrFiner { uint requested_or_finer[]; };
layout(set = 0, binding = 5, scalar) buffer StateOut { PageState state; };

#include "shadow/parameterization/paged/page_request.glsl"

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ivec2(camera.size)))) return;
  Receiver r = receiver_at(pixel);
  if (!r.facing) return;
  vec4 plane = vec4(r.normal, -dot(r.normal, r.world));
  uint level = uint(map_level(r.world, plane));
  MapPoint p;
  if (!asks_for_finer(r.world, plane, level, p)) return;
  atomicAdd(state.raw_requests, 1);
  for (uint l = level; l < min(level + paged.footprint_levels, paged.coarsest + 1); ++l)
    request_level(p, point_face(p), l);
}
