// The paper's tessellation (section 6.1): a triangle's edges are cut so that none is longer than a share of the map. An edge's factor
// follows from its two ends alone, the same for both of its triangles, so no crack opens. Factors end at 32, of the 64 that Vulkan
// promises, see bent_draws_per_cluster: pieces of longer edges stay longer.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/rectilinear/rectilinear.glsl"

layout(vertices = 3) out;

// Of the edge from a to b, homogeneous flat; one that passes the light is left alone.
float factor(vec4 a, vec4 b) {
  if (min(a.w, b.w) <= 0.0) return 1.0;
  vec2 from = clamp(warp_point(a.xy / a.w), -0.5, 1.5), to = clamp(warp_point(b.xy / b.w), -0.5, 1.5);
  return clamp(ceil(distance(from, to) / warp.longest_edge), 1.0, 32.0);
}

void main() {
  gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;
  if (gl_InvocationID != 0) return;
  vec4 a = gl_in[0].gl_Position, b = gl_in[1].gl_Position, c = gl_in[2].gl_Position;
  gl_TessLevelOuter[0] = factor(b, c);
  gl_TessLevelOuter[1] = factor(c, a);
  gl_TessLevelOuter[2] = factor(a, b);
  gl_TessLevelInner[0] = max(gl_TessLevelOuter[0], max(gl_TessLevelOuter[1], gl_TessLevelOuter[2]));
}
