// Marks the pages that each camera pixel will read: one bit a page (its own and those its filter touches), and in a second mask
// every page that is marked or holds one that is.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#define SHADEWRIGHT_LOADS_FIRST 1
#include "shadow/parameterization/paged/paged.glsl"
#include "shadow/receivers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 3, scalar) buffer Requested { uint requested[]; };
layout(set = 0, binding = 4, scalar) buffer RequestedOrFiner { uint requested_or_finer[]; };
layout(set = 0, binding = 5, scalar) buffer StateOut { PageState state; };

shared uint group_requests;

#include "shadow/parameterization/paged/page_request.glsl"

void main() {
  load_lookup();
  load_camera();
  load_map();
  if (gl_LocalInvocationIndex == 0) group_requests = 0;
  barrier();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy * paged.analysis_scale);
  if (all(lessThan(pixel, ivec2(camera.size)))) {
    Receiver r = receiver_at(pixel);
    if (r.facing) {
      vec4 plane = vec4(r.normal, -dot(r.normal, r.world));
      uint face = paged_face(r.world), level = uint(map_level(r.world, plane));
      MapPoint p = map_project(map_view(face), 0, r.world, plane, vec2(0.0));
      for (uint l = level; l < min(level + paged.footprint_levels, paged.coarsest + 1); ++l) request_level(p, face, l);
      atomicAdd(group_requests, 1);
    }
  }
  barrier();
  if (gl_LocalInvocationIndex == 0 && group_requests > 0) atomicAdd(state.raw_requests, group_requests);
}
