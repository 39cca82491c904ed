// The depth of a texel of a bent triangle (bent.geom): of the triangle's plane where the texel's centre lies, in flat coordinates, in
// which depth is linear. Interpolated over the warped triangle, depth would be wrong by the triangle's size, and no bias right.
#include "shadow/parameterization/rectilinear/rectilinear.glsl"

layout(location = 0) flat in vec4 depth_plane;
layout(location = 1) flat in vec3 origin;

float bent_depth(ivec2 texel) {
  vec2 from_origin = flat_of_texel_center(texel) - origin.xy;
  return clamp(dot(depth_plane.xyz, vec3(from_origin, 1.0)), depth_plane.w, origin.z);
}
