// Which way to turn the light's image plane: the expected error of each orientation, estimated from a grid of the camera's pixels.
// One group an orientation. (The paper's future work, its section 7.)
//
// A row of the map that holds importance A and gets the share s of it has error A / s: its texels, as the picture sees them.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/map_point.glsl"
#include "shadow/receivers.glsl"
#include "shadow/parameterization/rectilinear/shared.h"
#include "shadow/parameterization/rectilinear/known.glsl"
#include "shadow/parameterization/rectilinear/importance.glsl"
#include "shadow/parameterization/rectilinear/accumulate.glsl"

layout(local_size_x = 128) in;
layout(set = 0, binding = 5, scalar) readonly buffer History { WarpHistory history; };

const uint bins = 128, threads = gl_WorkGroupSize.x, per_thread = orientation_samples * orientation_samples / threads;
// An orientation is only left for one that is clearly better, where frames are blended.
const float kept_for = 0.8;

shared uint low_inverted[2], high[2], greatest[2 * bins], sums[2 * bins];
shared float errors[2];

void main() {
  uint me = gl_LocalInvocationID.x, index = gl_WorkGroupID.x;
  Orientation o = constants.orientations[index];
  if (me < 2) low_inverted[me] = high[me] = 0;
  for (uint i = me; i < 2 * bins; i += threads) greatest[i] = sums[i] = 0;
  barrier();
  vec2 at[per_thread], value[per_thread];
  for (uint i = 0; i < per_thread; ++i) {
    uint s = i * threads + me;
    ivec2 pixel = ivec2((vec2(s % orientation_samples, s / orientation_samples) + 0.5) * vec2(camera.size) / float(orientation_samples));
    Receiver r = receiver_at(pixel);
    value[i] = vec2(0.0);
    if (!r.facing) continue;
    vec4 q = map_views[0].map_from_world * vec4(r.world, 1.0);
    vec3 map = q.xyz / q.w;
    at[i] = clamp(vec2(dot(o.u, vec3(map.xy, 1.0)), dot(o.v, vec3(map.xy, 1.0))), 0.0, 1.0);
    value[i] = importance(camera, camera_view_depth(camera, texelFetch(camera_depth, pixel, 0).r), r, map, o, constants);
    for (int axis = 0; axis < 2; ++axis) {
      atomicMax(low_inverted[axis], ~floatBitsToUint(at[i][axis]));
      atomicMax(high[axis], floatBitsToUint(at[i][axis]));
    }
  }
  barrier();
  vec2 low = vec2(uintBitsToFloat(~low_inverted[0]), uintBitsToFloat(~low_inverted[1]));
  vec2 size = max(vec2(uintBitsToFloat(high[0]), uintBitsToFloat(high[1])) - low, 1e-6);
  for (uint i = 0; i < per_thread; ++i) {
    if (value[i].x <= 0.0) continue;
    for (uint axis = 0; axis < 2; ++axis) {
      uint bin = axis * bins + min(uint((at[i][axis] - low[axis]) / size[axis] * float(bins)), bins - 1);
      atomicMax(greatest[bin], floatBitsToUint(value[i][axis]));
      atomicAdd(sums[bin], max(1u, uint(value[i][axis] * 1048576.0)));
    }
  }
  barrier();
  if (me < 2) {
    float total = 0.0, roots = 0.0, maxima = 0.0, by_maxima = 0.0;
    for (uint i = 0; i < bins; ++i) {
      float sum = float(sums[me * bins + i]), most = uintBitsToFloat(greatest[me * bins + i]);
      total += sum;
      roots += sqrt(sum);
      maxima += most;
      if (most > 0.0) by_maxima += sum / most;
    }
    float uniform_error = total * float(bins), warped_error = collapse == collapse_sum ? roots * roots : by_maxima * maxima;
    // Pixels a step are of the whole, which the orientation scales; the other functions are not.
    float unit = (functions & importance_pixels) != 0 ? 1.0 : o.size[me];
    errors[me] = min(uniform_error, warped_error) * size[me] * unit;
  }
  barrier();
  if (me == 0 && high[0] >= ~low_inverted[0] && low_inverted[0] != 0) {
    float error = errors[0] + errors[1];
    if (constants.temporal > 0.0 && constants.history_holds != 0 && history.orientation[0] == index) error *= kept_for;
    atomicMax(accumulated.best_orientation, ~((floatBitsToUint(error) & ~31u) | index));
  }
}
