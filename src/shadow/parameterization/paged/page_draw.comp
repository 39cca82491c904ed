// The draw of the (triangle, page) pairs of a round.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/parameterization/paged/pages.h"

layout(local_size_x = 1) in;
layout(binding = 0, scalar) buffer StateOut { PageState state; };
layout(push_constant, scalar) uniform Push { BinConstants constants; };

void main() {
  state.vertex_count = min(state.wanted_vertices, constants.vertex_capacity / 3 * 3);
  state.instance_count = 1;
  state.pairs += state.vertex_count / 3;
}
