// One direction of the box blur of a moments map: mean and variance of the texels around each, within the layer.
// The variance of a union is the mean of the variances plus the variance of the means (law of total variance); taken about the
// texel's own mean nothing cancels, where the difference of raw second moments would lose all digits far from the light.
// A fragment shader: a CPU device writes a color attachment faster than a storage image. Shared memory costs it more than the
// texels themselves, and runs of texels an invocation have to be kept in arrays, which do too.
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(binding = 0) uniform sampler2DArray source;
layout(push_constant, scalar) uniform Push {
  ivec2 step;  // (1, 0) or (0, 1)
  int radius;
  int layer;
};
layout(location = 0) out vec2 moments;

void main() {
  ivec2 size = textureSize(source, 0).xy, texel = ivec2(gl_FragCoord.xy);
  int place = step.x != 0 ? texel.x : texel.y, last = step.x != 0 ? size.x - 1 : size.y - 1;
  int before = min(radius, place), after = min(radius, last - place);
  float own = texelFetch(source, ivec3(texel, layer), 0).r;
  float count = 0.0, sum = 0.0, squares = 0.0;
  for (int i = -before; i <= after; ++i) {
    vec2 m = texelFetch(source, ivec3(texel + i * step, layer), 0).rg;
    float d = m.r - own;
    sum += d;
    squares += d * d + m.g;
    count += 1.0;
  }
  float mean = sum / count;
  moments = vec2(own + mean, max(squares / count - mean * mean, 0.0));
}
