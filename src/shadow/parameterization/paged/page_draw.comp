// Completes the draws of the (triangle, page) pairs of a round.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/shared.h"

layout(local_size_x = 1) in;
layout(binding = 0, scalar) buffer StateOut { PageState state; };
layout(push_constant, scalar) uniform Push { BinConstants constants; };

void main() {
  for (uint kind = 0; kind < pair_kinds; ++kind) {
    uint capacity = (constants.first_pair[kind + 1] - constants.first_pair[kind]) * 3;
    state.draws[kind].vertex_count = min(state.draws[kind].vertex_count, capacity);
    state.draws[kind].first_vertex = 3 * constants.first_pair[kind];
    state.pairs += state.draws[kind].vertex_count / 3;
  }
}
