// requests=sort (RMSM, algorithm 2, steps 1 to 3): the number of the page that each camera pixel asks for at each level it reads, ~0
// where it asks for none: no receiver, or with REFINE_EDGES (ASM, algorithm 1, steps 3 to 7) no shadow's edge. The further pages of a
// filter that reaches over a border follow behind, as long as there is room; those beyond are marked at once.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"
#ifdef REFINE_EDGES
#include "shadow/parameterization/paged/page_edge.glsl"
#endif
#include "shadow/receivers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 3, scalar) buffer Requested { uint requested[]; };
layout(set = 0, binding = 4, scalar) buffer RequestedOrFiner { uint requested_or_finer[]; };
layout(set = 0, binding = 5, scalar) buffer StateOut { PageState state; };
layout(set = 0, binding = 6, scalar) writeonly buffer Requests { uint requests[]; };

shared uint group_requests;

#include "shadow/parameterization/paged/page_request.glsl"

void list_requests(ivec2 pixel) {
  Receiver r = receiver_at(pixel);
  if (!r.facing) return;
  uint pixels = uint(camera.size.x) * uint(camera.size.y), index = uint(pixel.y) * uint(camera.size.x) + uint(pixel.x);
  vec4 plane = vec4(r.normal, -dot(r.normal, r.world));
  uint face = paged_face(r.world), level = uint(map_level(r.world, plane));
#ifdef REFINE_EDGES
  MapPoint p;
  if (!asks_for_finer(r.world, plane, level, p)) return;
#endif
  vec2 uv = paged_uv(r.world, face);
  atomicAdd(group_requests, 1);
  for (uint i = 0; i < paged.footprint_levels && level + i <= paged.coarsest; ++i) {
    float size = level_size(level + i);
    vec2 low = floor(uv * size - paged.footprint), high = floor(uv * size + paged.footprint);
    uvec2 a = uvec2(clamp(low, vec2(0.0), vec2(size - 1.0))) / page_texels, b = uvec2(clamp(high, vec2(0.0), vec2(size - 1.0))) / page_texels;
    requests[i * pixels + index] = page_index(face, level + i, a);
    for (uint k = 1; k < 4; ++k) {
      uvec2 page = uvec2((k & 1) != 0 ? b.x : a.x, (k & 2) != 0 ? b.y : a.y);
      if (page == a || ((k & 1) != 0 && a.x == b.x) || ((k & 2) != 0 && a.y == b.y)) continue;  // named already
      uint place = paged.footprint_levels * pixels + atomicAdd(state.border_requests, 1);
      if (place < requests.length()) {
        requests[place] = page_index(face, level + i, page);
      } else {
        request(face, level + i, page);
      }
    }
  }
}

void main() {
  if (gl_LocalInvocationIndex == 0) group_requests = 0;
  barrier();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(pixel, ivec2(camera.size)))) list_requests(pixel);
  barrier();
  if (gl_LocalInvocationIndex == 0 && group_requests > 0) atomicAdd(state.raw_requests, group_requests);
}
