// From accumulated importance to the warp of an axis (the paper's steps (b.ii) and (b.iii)); one group an axis.
//
// Equation 1 at cell edges: W[0] = 0, W[k + 1] = W[k] + I[k] / S. It is monotonic, fixes 0 and 1, and gives each super-cell its
// share of the blurred importance. What lies outside the useful rows is cut before: flat coordinates begin and end there.
// collapse_max: I is the greatest importance of a row, as in the paper. collapse_sum: the root of the sum, which makes the sum of
// all samples' errors, importance / share, least.
//
// Casters can be drawn without any error only where the warp is linear, so super-cells that deserve about the same make one
// segment: a few dozen segments lose next to nothing against 512, and few triangles cross their borders.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/rectilinear/shared.h"
#include "shadow/parameterization/rectilinear/known.glsl"

layout(local_size_x = 256) in;
layout(binding = 0, scalar) uniform Constants { WarpConstants constants; };
layout(binding = 1, scalar) readonly buffer Accumulated { Importance accumulated; };
layout(binding = 2, scalar) buffer Warp { WarpData warp; WarpSegment segments[]; };
layout(binding = 3, scalar) buffer History { WarpHistory history; };
layout(binding = 4, scalar) writeonly buffer Figures { WarpFigures figures; };

const uint threads = gl_WorkGroupSize.x;
// An axis is warped if that is expected to leave at most this much of its error. Expectations know nothing of where shadows end:
// a smaller gain may turn out as a loss.
const float worth_it = 0.85;
// Of the mean: no super-cell vanishes between useful ones. Forward analysis does not see receivers in shadow, so that a super-cell
// without importance may hold the most of them.
const float interior_floor = 1e-4, unseen_floor = 0.05;

shared float raw[max_cells], values[max_cells], totals[threads];

// The useful part of the axis, of the whole's [0, 1]. All of it where nothing receives; and in forward analysis, which does not
// see receivers in shadow.
vec2 useful(uint axis) {
  if (accumulated.low_inverted[axis] == 0 || constants.forward != 0 || (functions & importance_view) == 0)
    return vec2(0.0, 1.0);
  float low = uintBitsToFloat(~accumulated.low_inverted[axis]), high = uintBitsToFloat(accumulated.high[axis]);
  // Float rounding of a receiver's coordinate, and a part of a texel.
  float margin = max(2e-6, 0.25 * (high - low) / float(constants.resolution));
  return vec2(low - margin, high + margin);
}

// The sum of all invocations' values, for each of them.
float sum_of_all(float mine) {
  barrier();
  totals[gl_LocalInvocationID.x] = mine;
  barrier();
  float sum = 0.0;
  for (uint i = 0; i < threads; ++i) sum += totals[i];
  return sum;
}

// raw[k] to values[k]. At the ends of the useful part the Gaussian's weights are normalized: nothing is lost to what is cut.
void blur(uint n) {
  barrier();
  int reach = int(ceil(3.0 * constants.sigma));
  for (uint k = gl_LocalInvocationID.x; k < n; k += threads) {
    float value = raw[k], weights = 1.0;
    for (int d = 1; d <= reach; ++d) {
      float weight = exp(-0.5 * float(d * d) / (constants.sigma * constants.sigma));
      if (int(k) - d >= 0) { value += weight * raw[k - d]; weights += weight; }
      if (int(k) + d < int(n)) { value += weight * raw[k + d]; weights += weight; }
    }
    values[k] = value / weights;
  }
  barrier();
}

// Every super-cell a segment (the paper). Returns how many there are.
uint segments_of_cells(uint axis, uint n) {
  // Prefix sums: each invocation its own run of cells, then the runs.
  uint me = gl_LocalInvocationID.x, run = (n + threads - 1) / threads, begin = min(n, me * run), end = min(n, begin + run);
  float mine = 0.0;
  for (uint k = begin; k < end; ++k) mine += values[k];
  float all = sum_of_all(mine), before = 0.0;
  for (uint i = 0; i < me; ++i) before += totals[i];
  for (uint k = begin; k < end; ++k) {
    segments[axis * n + k] = WarpSegment(float(k) / float(n), before / all, values[k] / all * float(n), 0.0);
    warp.first_segments[axis * max_cells + k] = k;
    before += values[k];
  }
  return n;
}

// Runs of super-cells that share their texels evenly. A run of length L whose cells deserve v_k, and so hold importance v_k^2, leaves
// the least error with a share of sqrt(L sum v_k^2) instead of sum v_k: by so much a run costs. All runs may cost about the same, as
// little as the number of segments allows.
const float least_cost = 0.001, cost_step = 1.04;  // of the sum of all values

shared uint run_counts[threads], run_starts[max_cut_segments + 1];

float run_value(float squares, uint size) { return sqrt(squares * float(size)); }

uint find_runs(uint n, float most_cost, uint most, bool write) {
  uint count = 1, start = 0;
  float sum = 0.0, squares = 0.0;
  if (write) run_starts[0] = 0;
  for (uint k = 0; k < n; ++k) {
    sum += values[k];
    squares += values[k] * values[k];
    if (k == start || run_value(squares, k + 1 - start) - sum <= most_cost) continue;
    if (count == most) return most + 1;
    if (write) run_starts[count] = k;
    ++count;
    start = k;
    sum = values[k];
    squares = values[k] * values[k];
  }
  return count;
}

float run_value_of(uint i) {
  float squares = 0.0;
  for (uint k = run_starts[i]; k < run_starts[i + 1]; ++k) squares += values[k] * values[k];
  return run_value(squares, run_starts[i + 1] - run_starts[i]);
}

// Returns how many there are. Their borders lie at edges of texels, so that a texel lies in one segment.
uint segments_of_runs(uint axis, uint n) {
  uint me = gl_LocalInvocationID.x, most = clamp(constants.resolution / 8, 1u, constants.max_segments);
  float mine = 0.0;
  for (uint k = me; k < n; k += threads) mine += values[k];
  float cost = least_cost * sum_of_all(mine);
  run_counts[me] = find_runs(n, cost * pow(cost_step, float(me)), most, false);
  barrier();
  uint step = 0;
  while (step + 1 < threads && run_counts[step] > most) ++step;
  uint count = run_counts[step];
  if (me == 0) {
    find_runs(n, cost * pow(cost_step, float(step)), most, true);
    run_starts[count] = n;
    float all = 0.0, before = 0.0;
    for (uint i = 0; i < count; ++i) all += run_value_of(i);
    uint texel = 0;
    for (uint i = 0; i < count; ++i) {
      for (uint k = run_starts[i]; k < run_starts[i + 1]; ++k) warp.first_segments[axis * max_cells + k] = i;
      before += run_value_of(i);
      uint end = i + 1 == count ? constants.resolution
                                : clamp(uint(before / all * float(constants.resolution) + 0.5), texel + 1, constants.resolution - (count - 1 - i));
      float flat_size = float(run_starts[i + 1] - run_starts[i]) / float(n), texels = float(end - texel);
      segments[axis * n + i] = WarpSegment(float(run_starts[i]) / float(n), float(texel) / float(constants.resolution),
                                           texels / float(constants.resolution) / flat_size, 0.0);
      texel = end;
    }
  }
  return count;
}

void main() {
  uint axis = gl_WorkGroupID.x, me = gl_LocalInvocationID.x, n = constants.cells;
  uint orientation = orientation_index(accumulated.best_orientation);
  Orientation o = constants.orientations[orientation];
  vec2 range = useful(axis);
  float cell_size = (range.y - range.x) / float(n);

  for (uint k = me; k < n; k += threads) {
    float from = (range.x + float(k) * cell_size) * importance_bins, to = from + cell_size * importance_bins;
    uint first = uint(clamp(from, 0.0, importance_bins - 1.0)), last = uint(clamp(to, 0.0, importance_bins - 1.0));
    uint bits = 0;
    float sum = 0.0;
    for (uint bin = first; bin <= last; ++bin) {
      bits = max(bits, accumulated.greatest[axis * importance_bins + bin]);
      sum += float(accumulated.sums[axis * importance_bins + bin]) * max(0.0, min(to, float(bin + 1)) - max(from, float(bin)));
    }
    raw[k] = collapse == collapse_sum ? sum : uintBitsToFloat(bits);
    // The segments' places keep the sums until they are written.
    segments[axis * n + k].half_texel = sum;
  }
  blur(n);

  // Importance by metres: what a frame's neighbours can be blended with.
  vec2 metres = vec2(o.offset[axis] + range.x * o.size[axis], (range.y - range.x) * o.size[axis]);
  float by_metre = collapse == collapse_sum ? float(n) / metres.y : 1.0;
  float sum = 0.0;
  bool blended = constants.temporal > 0.0 && constants.history_holds != 0 && history.orientation[axis] == orientation;
  for (uint k = me; k < n; k += threads) {
    float value = values[k] * by_metre;
    if (collapse == collapse_sum) value = sqrt(value);
    if (blended) {
      float at = (metres.x + (float(k) + 0.5) / float(n) * metres.y - history.low[axis]) / history.size[axis] * float(n);
      if (at >= 0.0 && at < float(n)) value = mix(value, history.importance[axis * max_cells + uint(at)], constants.temporal);
    }
    values[k] = value;
    sum += value;
  }
  sum = sum_of_all(sum);
  float least = sum > 0.0 ? (constants.forward != 0 ? unseen_floor : interior_floor) * sum / float(n) : 1.0;

  // What the warp is expected to cost, and what none would: where it does not help, there is none.
  float all = 0.0, samples = 0.0, error = 0.0;
  for (uint k = me; k < n; k += threads) {
    values[k] = max(values[k], least);
    all += values[k];
    samples += segments[axis * n + k].half_texel;
    error += segments[axis * n + k].half_texel / values[k];
  }
  all = sum_of_all(all);
  samples = sum_of_all(samples);
  error = sum_of_all(error) * all / float(n);
  bool helps = error < worth_it * samples || constants.forward != 0;
  if (me == 0) {
    figures.error_ratio[axis] = helps && samples > 0.0 ? error / samples : 1.0;
    if (axis == 0) figures.orientation = orientation;
    history.orientation[axis] = orientation;
    history.low[axis] = metres.x;
    history.size[axis] = metres.y;
  }

  for (uint k = me; k < n; k += threads) {
    history.importance[axis * max_cells + k] = values[k];
    if (!helps) values[k] = 1.0;
  }
  barrier();
  uint count = constants.max_segments == 0 ? segments_of_cells(axis, n) : segments_of_runs(axis, n);
  memoryBarrierBuffer();
  barrier();
  if (me != 0) return;
  float steepest = 0.0;
  for (uint i = 0; i < count; ++i) steepest = max(steepest, segments[axis * n + i].slope);
  warp.header.segment_counts[axis] = count;
  for (uint i = 0; i < few_segments; ++i) {
    WarpSegment s = segments[axis * n + min(i, count - 1)];
    warp.header.few[axis * few_segments + i] = vec3(i < count ? s.flat_start : 1e30, s.start, s.slope);
  }
  figures.finest[axis] = steepest / (range.y - range.x);

  vec3 row = axis == 0 ? o.u : o.v;
  row.z -= range.x;
  warp.header.flat_from_map[axis] = row / (range.y - range.x);
  if (axis == 0) {
    warp.header.cells = n;
    warp.header.resolution = constants.resolution;
    warp.header.longest_edge = constants.longest_edge;
    warp.header.cut = constants.max_segments;
    vec2 other = useful(1);
    mat2 back = inverse(transpose(mat2(o.u.xy, o.v.xy)));
    vec2 at = back * (vec2(range.x, other.x) - vec2(o.u.z, o.v.z));
    vec2 step_u = back[0] * (range.y - range.x), step_v = back[1] * (other.y - other.x);
    warp.header.map_from_flat[0] = vec3(step_u.x, step_v.x, at.x);
    warp.header.map_from_flat[1] = vec3(step_u.y, step_v.y, at.y);
  }
}
