// The camera's picture of pages (RMSM, figure 4): each pixel in the colour of the level that answers it, page borders dark.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/paged.glsl"
#include "shadow/receivers.glsl"
#include "shadow/receiver_strip.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 3, scalar) writeonly buffer Picture { uint picture[]; };

// Blue for the finest level over green to red for the coarsest, every other one darker.
vec3 level_color(uint level) {
  float t = float(level) / float(max(paged.top, 1u));
  vec3 color = clamp(vec3(3.0 * t - 1.0, 1.0 - abs(3.0 * t - 1.0), 1.0 - 3.0 * t), 0.15, 1.0);
  return color * (level % 2 == 0 ? 1.0 : 0.75);
}

void main() {
  ivec2 pixel = strip_pixel(ivec2(gl_GlobalInvocationID.xy));
  if (any(greaterThanEqual(pixel, ivec2(camera.size)))) return;
  Receiver r = receiver_at(pixel);
  vec3 color = r.background ? vec3(1.0) : vec3(0.3);
  if (r.facing) {
    MapPoint p = map_point(r.world, vec4(r.normal, -dot(r.normal, r.world)));
    vec2 inside = fract(p.uv / p.texel / float(page_texels)) * float(page_texels);
    bool border = any(lessThan(inside, vec2(1.0)));
    color = p.valid ? level_color(point_level(p)) * (border ? 0.35 : 1.0) : vec3(1.0, 0.0, 1.0);
  }
  picture[strip_index(pixel)] = packUnorm4x8(vec4(color, 1.0));
}
