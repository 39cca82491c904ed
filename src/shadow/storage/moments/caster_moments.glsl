// What a fragment of a caster writes into a moments map; needs a parameterization before it. Include it in the fragment shader of
// casters of your own, which writes the result to color 0.
#include "shadow/storage/moments/light_distance.glsl"

// Mean and variance of the light's distance over the fragment's texel. `relative` is world position - moments_origin(),
// interpolated. A plane whose distance changes by g over a texel has the variance g^2 / 12 there.
vec2 caster_moments(vec3 relative) {
  float mean = moments_distance(relative);
  vec2 g = vec2(dFdx(mean), dFdy(mean));
  return vec2(mean, dot(g, g) / 12.0);
}
