// A triangle of a warped map as the paper draws it: its corners are warped, its edges straight. It hands its plane in flat
// coordinates to the fragments, which take their depth from it (see bent_fragment.glsl).
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/rectilinear/rectilinear.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;
layout(location = 0) flat out vec4 depth_plane;  // d depth / d flat, depth at the origin, least depth
layout(location = 1) flat out vec3 origin;       // flat, greatest depth

// Corners nearer to the light's plane than this, relative to the farthest, are cut off: behind it nothing can be warped.
const float nearest_w = 1e-4;

vec4 out_plane;
vec3 out_origin;

void emit(vec4 p) {
  depth_plane = out_plane;
  origin = out_origin;
  gl_Position = vec4(2.0 * warp_point(p.xy / p.w) - 1.0, 0.0, 1.0);
  EmitVertex();
}

void main() {
  vec4 p[3] = vec4[3](gl_in[0].gl_Position, gl_in[1].gl_Position, gl_in[2].gl_Position);
  float least_w = nearest_w * max(max(p[0].w, p[1].w), p[2].w);
  if (least_w <= 0.0) return;
  vec4 corners[4];
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    vec4 a = p[i], b = p[(i + 1) % 3];
    if (a.w >= least_w) corners[count++] = a;
    if ((a.w >= least_w) != (b.w >= least_w)) corners[count++] = mix(a, b, (least_w - a.w) / (b.w - a.w));
  }
  if (count < 3) return;

  // Relative to a corner, for precision.
  vec2 o = corners[0].xy / corners[0].w;
  vec3 h[3];
  for (int i = 0; i < 3; ++i) h[i] = vec3(p[i].xy - o * p[i].w, p[i].w);
  vec3 e[3] = vec3[3](cross(h[1], h[2]), cross(h[2], h[0]), cross(h[0], h[1]));
  float area = dot(h[0], e[0]);
  if (area == 0.0) return;  // seen edge-on
  vec2 depths = vec2(corners[0].z / corners[0].w);  // least, greatest
  for (int i = 1; i < count; ++i) {
    float depth = corners[i].z / corners[i].w;
    depths = vec2(min(depths.x, depth), max(depths.y, depth));
  }
  out_plane = vec4((p[0].z * e[0] + p[1].z * e[1] + p[2].z * e[2]) / area, depths.x);
  out_origin = vec3(o, depths.y);

  emit(corners[0]);
  emit(corners[1]);
  emit(corners[count - 1]);
  if (count == 4) emit(corners[2]);
}
