// Casters into a superpage (RMSM, algorithm 2, step 11): a plain map of its part of a level.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"
#include "render/scene_vertex.glsl"

layout(push_constant, scalar) uniform Push { SuperpagePlace superpage; };

void main() {
  vec4 q = map_views[superpage.face].map_from_world * vec4(scene_world_position(), 1.0);
  vec2 first = vec2(superpage.first_page * page_texels);
  gl_Position = vec4((q.xy * level_size(superpage.level) - first * q.w) * (2.0 / float(superpage_texels)) - q.w, q.zw);
}
