// Copies a superpage's depths.
#version 460

layout(set = 0, binding = 1) uniform sampler2D superpage_depth;
layout(location = 0) flat in ivec2 from_pool;

void main() { gl_FragDepth = texelFetch(superpage_depth, ivec2(gl_FragCoord.xy) + from_pool, 0).r; }
