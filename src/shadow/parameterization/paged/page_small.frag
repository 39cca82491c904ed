// Throws away what lies outside of a pair's unit.
#version 460

layout(location = 0) flat in vec4 unit_texels;

void main() {
  if (any(lessThan(gl_FragCoord.xy, unit_texels.xy)) || any(greaterThan(gl_FragCoord.xy, unit_texels.zw))) discard;
}
