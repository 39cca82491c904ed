// One direction of the box blur of a moments map: mean and variance of the texels around each, within the layer.
// The variance of a union is the mean of the variances plus the variance of the means (law of total variance); taken about the
// texel's own mean nothing cancels, where the difference of raw second moments would lose all digits far from the light.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 64) in;
layout(binding = 0) uniform sampler2DArray source;
layout(binding = 1, rg32f) uniform writeonly image2DArray target;
layout(push_constant, scalar) uniform Push {
  ivec2 step;  // (1, 0) or (0, 1)
  int radius;
  int source_layer, target_layer;
};

void main() {
  ivec2 size = textureSize(source, 0).xy;
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, size))) return;
  int place = step.x != 0 ? texel.x : texel.y, last = step.x != 0 ? size.x - 1 : size.y - 1;
  int before = min(radius, place), after = min(radius, last - place);
  float own = texelFetch(source, ivec3(texel, source_layer), 0).r;
  float count = 0.0, sum = 0.0, squares = 0.0;
  for (int i = -before; i <= after; ++i) {
    vec2 m = texelFetch(source, ivec3(texel + i * step, source_layer), 0).rg;
    float d = m.r - own;
    sum += d;
    squares += d * d + m.g;
    count += 1.0;
  }
  float mean = sum / count;
  imageStore(target, ivec3(texel, target_layer), vec4(own + mean, max(squares / count - mean * mean, 0.0), 0.0, 0.0));
}
