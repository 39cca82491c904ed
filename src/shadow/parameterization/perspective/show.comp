// Debug picture "aliasing": the paper's measure d (section 1.1), the size of the map's texel in the image, in pixels. It
// holds d = d_s r_s / r_i cos(beta) / cos(alpha) for any projection: the texel's sides on the receiver, projected.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/perspective/perspective.glsl"
#include "shadow/receivers.glsl"
#include "shadow/receiver_strip.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 3, scalar) writeonly buffer Sizes { float sizes[]; };  // below 0: no texel is asked

const float background = -1.0, unasked = -2.0;

void main() {
  ivec2 pixel = strip_pixel(ivec2(gl_GlobalInvocationID.xy));
  if (any(greaterThanEqual(pixel, ivec2(camera.size)))) return;
  uint index = strip_index(pixel);
  Receiver r = receiver_at(pixel);
  sizes[index] = r.background ? background : unasked;
  if (!r.facing) return;
  MapPoint p = map_point(r.world, vec4(r.normal, -dot(r.normal, r.world)));
  if (!p.valid) return;
  mat3 ndc_from_ray = inverse(camera.ray_from_ndc);
  vec3 here = ndc_from_ray * (r.world - camera.eye);
  vec2 sides[2];
  for (int axis = 0; axis < 2; ++axis) {
    vec2 uv = p.uv;
    uv[axis] += p.texel[axis];
    Ray ray = map_ray(p, uv);
    vec3 there = ray.origin + ray.direction * (dot(r.world - ray.origin, r.normal) / dot(ray.direction, r.normal));
    // Without the rounding that the difference of two images has.
    vec3 step = ndc_from_ray * (there - r.world);
    sides[axis] = 0.5 * vec2(camera.size) * (step.xy - here.xy / here.z * step.z) / (here.z + step.z);
  }
  sizes[index] = sqrt(abs(sides[0].x * sides[1].y - sides[0].y * sides[1].x));
}
