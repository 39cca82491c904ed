// Octahedral map of a unit vector to [-1, 1]^2 and back (Cigolle et al. 2014).
#ifndef SHADEWRIGHT_RENDER_OCTAHEDRAL_GLSL
#define SHADEWRIGHT_RENDER_OCTAHEDRAL_GLSL

vec2 octahedral_encode(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
}

// The vector's direction; its length is between 0.57 and 1.
vec3 octahedral_direction(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
  return n;
}

vec3 octahedral_decode(vec2 p) { return normalize(octahedral_direction(p)); }

#endif
