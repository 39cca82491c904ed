// The paper's step (b.i): the greatest importance of each row and column of the two-dimensional map. One invocation a row.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/rectilinear/shared.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) uniform Constants { WarpConstants constants; };
layout(binding = 1, scalar) writeonly buffer Accumulated { Importance accumulated; };
layout(binding = 2, scalar) readonly buffer ImportanceMap { uint importance_map[]; };

void main() {
  uint n = constants.map_size, row = gl_GlobalInvocationID.x, axis = gl_GlobalInvocationID.y;
  if (row >= n) return;
  uint greatest = 0;
  for (uint i = 0; i < n; ++i) greatest = max(greatest, importance_map[axis == 0 ? i * n + row : row * n + i]);
  uint first = row * importance_bins / n, last = (row + 1) * importance_bins / n;
  for (uint bin = first; bin < last; ++bin) accumulated.greatest[axis * importance_bins + bin] = greatest;
}
