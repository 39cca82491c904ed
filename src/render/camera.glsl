// Surface points from a camera's depth and normal buffers.
#ifndef SHADEWRIGHT_RENDER_CAMERA_GLSL
#define SHADEWRIGHT_RENDER_CAMERA_GLSL

#include "render/shared.h"

float camera_view_depth(CameraData camera, float depth) { return camera.depth_offset / (depth - camera.depth_scale); }

vec3 camera_ray(CameraData camera, vec2 pixel) {
  vec2 ndc = 2.0 * pixel / vec2(camera.size) - 1.0;
  return camera.ray_from_ndc * vec3(ndc, 1.0);
}

// World position of the surface that covers the centre of `pixel`.
vec3 camera_surface(CameraData camera, ivec2 pixel, float depth) {
  return camera.eye + camera_ray(camera, vec2(pixel) + 0.5) * camera_view_depth(camera, depth);
}

#endif
