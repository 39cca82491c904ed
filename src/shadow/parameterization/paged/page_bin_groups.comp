// Begins a round of page_bin.comp: one work group a touched cluster, or one a cluster that did not fit into the last round.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/shared.h"

layout(local_size_x = 1) in;
layout(binding = 0, scalar) buffer StateOut { PageState state; };
layout(push_constant, scalar) uniform Push { BinConstants constants; };

void main() {
  if (constants.round > 0) state.visible_clusters = state.late_clusters;
  state.late_clusters = state.late_triangles = 0;
  for (uint kind = 0; kind < pair_kinds; ++kind) state.draws[kind] = DrawArrays(0, 1, 0, 0);
  uint count = min(state.visible_clusters, constants.cluster_capacity);
  state.bin_groups = uvec3(min(count, 32768u), (count + 32767u) / 32768u, 1u);
}
