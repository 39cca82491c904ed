// Surface points from a camera's depth and normal buffers. Needs `CameraData` from render/shared.h.
#ifndef SHADEWRIGHT_RENDER_CAMERA_GLSL
#define SHADEWRIGHT_RENDER_CAMERA_GLSL

#include "geometry/position_error.h"

// Octahedral map of a unit vector to [-1, 1]^2 and back (Cigolle et al. 2014).
vec2 octahedral_encode(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
}

vec3 octahedral_decode(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
  return normalize(n);
}

float camera_view_depth(CameraData camera, float depth) { return camera.depth_offset / (depth - camera.depth_scale); }

vec3 camera_ray(CameraData camera, vec2 pixel) {
  vec2 ndc = 2.0 * pixel / vec2(camera.size) - 1.0;
  return camera.ray_from_ndc * vec3(ndc, 1.0);
}

// World position of the surface that covers the centre of `pixel`.
vec3 camera_surface(CameraData camera, ivec2 pixel, float depth) {
  return camera.eye + camera_ray(camera, vec2(pixel) + 0.5) * camera_view_depth(camera, depth);
}

// Bound of the distance between a surface point and its true plane: float arithmetic of the world coordinates and of 1/w
// interpolated over the screen. The same bound as shadewright::position_error (raytrace).
float camera_position_error(CameraData camera, vec3 world) {
  vec3 a = abs(world);
  return position_error_scale * (a.x + a.y + a.z + distance(world, camera.eye));
}

#endif
