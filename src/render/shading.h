// How a surface is lit for a person to judge shadows by, for C++ and GLSL alike.
#ifndef SHADEWRIGHT_RENDER_SHADING_H
#define SHADEWRIGHT_RENDER_SHADING_H

#ifdef __cplusplus
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#define SHADEWRIGHT_FUNCTION inline
namespace shadewright::shared {
using glm::vec3;
using std::max;
using std::min;
using std::pow;
#else
#define SHADEWRIGHT_FUNCTION
#endif

// The sky, linear: straight up and at the horizon.
const vec3 sky_zenith = vec3(0.32f, 0.46f, 0.72f), sky_horizon = vec3(0.72f, 0.80f, 0.88f);

/// What is seen where there is no surface.
SHADEWRIGHT_FUNCTION vec3 background_radiance() {
  return 0.9f * mix(sky_horizon, sky_zenith, 0.35f);
}

/// Light that reaches a surface from everywhere but the light: a sky above, a darker ground below.
SHADEWRIGHT_FUNCTION vec3 ambient_radiance(vec3 normal) {
  const vec3 ground_bounce = vec3(0.16f, 0.14f, 0.12f);
  return 0.55f * mix(ground_bounce, mix(sky_horizon, sky_zenith, 0.5f), 0.5f + 0.5f * normal.y);
}

/// Linear radiance of a surface. `to_light` is the unit vector towards a sun, or leads to a lamp (metres), which is as
/// bright as the sun at `lamp_distance`; that is 0 for a sun. `visibility` is 0 to 1.
SHADEWRIGHT_FUNCTION vec3 surface_radiance(vec3 albedo, vec3 normal, vec3 to_light, float lamp_distance,
                                           float visibility) {
  const vec3 sun_radiance = vec3(3.0f, 2.85f, 2.55f);
  float away = length(to_light);
  float falloff = lamp_distance > 0.0f ? lamp_distance * lamp_distance / (away * away) : 1.0f;
  float cosine = max(0.0f, dot(normal, to_light) / away);
  return albedo * (ambient_radiance(normal) + sun_radiance * (cosine * visibility * min(falloff, 16.0f)));
}

/// A channel of linear radiance as it is shown: highlights rolled off smoothly (Reinhard, with white at 4), sRGB, 0 to
/// 1.
SHADEWRIGHT_FUNCTION float displayed(float radiance) {
  float tone = radiance * (1.0f + radiance / 16.0f) / (1.0f + radiance);
  float x = max(0.0f, min(tone, 1.0f));
  return x <= 0.0031308f ? 12.92f * x : 1.055f * pow(x, 1.0f / 2.4f) - 0.055f;
}

#ifdef __cplusplus
}  // namespace shadewright::shared
#endif
#undef SHADEWRIGHT_FUNCTION
#endif
