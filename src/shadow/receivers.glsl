// The receivers of a look-up: the camera pass's surface points that face the light. Set 0 of a look-up begins with these.
#include "render/camera.glsl"
#include "render/octahedral.glsl"
#include "shadow/loads_first.glsl"

layout(set = 0, binding = 0, scalar) SHADEWRIGHT_UNIFORM(CameraData, camera, load_camera)
layout(set = 0, binding = 1) uniform sampler2D camera_depth;
layout(set = 0, binding = 2) uniform sampler2D camera_normal;

struct Receiver {
  vec3 world;
  vec3 normal;
  bool background;
  bool facing;  // geometry whose normal faces the light, inside a spot's cone
};

Receiver receiver_at(ivec2 pixel) {
  Receiver r;
  float depth = texelFetch(camera_depth, pixel, 0).r;
  r.background = depth == camera.background_depth;
  r.facing = false;
  if (r.background) return r;
  r.world = camera_surface(camera, pixel, depth);
  r.normal = octahedral_decode(texelFetch(camera_normal, pixel, 0).rg);
  vec3 to_light = light_kind() == light_directional ? -lookup.light_direction : lookup.light_position - r.world;
  r.facing = dot(r.normal, to_light) > 0.0;
  if (light_kind() == light_spot)
    r.facing = r.facing && dot(normalize(-to_light), lookup.light_direction) >= lookup.light_cos_outer;
  return r;
}

// How fast the receiver moves over its plane, world space, as the pixel moves by `by`.
vec3 receiver_step(Receiver r, ivec2 pixel, vec2 by) {
  vec3 ray = camera_ray(camera, vec2(pixel) + 0.5), change = camera_ray(camera, vec2(pixel) + 0.5 + by) - ray;
  float depth = dot(r.normal, r.world - camera.eye), facing = dot(r.normal, ray);
  facing = abs(facing) < 1e-20 ? 1e-20 : facing;
  return depth / facing * (change - ray * (dot(r.normal, change) / facing));
}
