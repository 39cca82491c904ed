// The distance that a moments map keeps: metres along the light's way, true in the world whatever the map's depth is.
#ifndef SHADEWRIGHT_SHADOW_LIGHT_DISTANCE_GLSL
#define SHADEWRIGHT_SHADOW_LIGHT_DISTANCE_GLSL

// Distances of a directional light count from the plane through the eye, where float is finest.
vec3 moments_origin() { return light_kind() == light_directional ? lookup.eye : lookup.light_position; }

float moments_distance(vec3 relative) {
  return light_kind() == light_directional ? dot(relative, lookup.light_direction) : length(relative);
}

#endif
