// The picture of two techniques' answers side by side: the scene lit with them, the answers themselves, or what is wrong
// with them over the grey scene.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "render/camera.glsl"
#include "render/octahedral.glsl"
#include "render/shading.h"
#include "../../apps/viewer/compose.h"

layout(binding = 0) uniform sampler2D depth_image;
layout(binding = 1) uniform sampler2D normal_image;
layout(binding = 2) uniform sampler2D albedo_image;
layout(binding = 3) uniform sampler2D left_image;
layout(binding = 4) uniform sampler2D right_image;
layout(binding = 5) uniform sampler2D truth_image;
layout(binding = 6, scalar) uniform Camera { CameraData camera; };
layout(push_constant, scalar) uniform Push { ComposeConstants compose; };
layout(location = 0) out vec4 color;

vec3 display(vec3 radiance) { return vec3(displayed(radiance.r), displayed(radiance.g), displayed(radiance.b)); }

vec3 grey(vec3 picture) { return vec3(0.25 + 0.5 * dot(picture, vec3(0.2126, 0.7152, 0.0722))); }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  bool right = gl_FragCoord.x > compose.divider;
  bool answered = (compose.answered & (right ? 2u : 1u)) != 0;
  float depth = texelFetch(depth_image, pixel, 0).r;
  float visibility = right ? texelFetch(right_image, pixel, 0).r : texelFetch(left_image, pixel, 0).r;
  if (!answered) visibility = 1.0;
  if (depth == camera.background_depth) {
    vec3 sky = display(background_radiance());
    if (compose.show == show_visibility) sky = vec3(visibility);
    if (compose.show == show_wrong) sky = grey(sky);
    color = vec4(sky, 1.0);
    return;
  }
  vec3 normal = octahedral_decode(texelFetch(normal_image, pixel, 0).rg);
  vec3 to_light = compose.light.xyz - compose.light.w * camera_surface(camera, pixel, depth);
  vec3 albedo = texelFetch(albedo_image, pixel, 0).rgb;
  vec3 picture = display(surface_radiance(albedo, normal, to_light, compose.lamp_distance, visibility));
  if (compose.show == show_visibility) picture = vec3(visibility);
  if (compose.show == show_wrong) {
    picture = grey(picture);
    bool truth = texelFetch(truth_image, pixel, 0).r >= 0.5;
    if (answered && dot(normal, to_light) > compose.least_cosine * length(to_light) && truth != (visibility >= 0.5))
      picture = truth ? compose.false_shadow : compose.false_lit;
  }
  color = vec4(picture, 1.0);
}
