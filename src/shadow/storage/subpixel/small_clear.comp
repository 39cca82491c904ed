// Empties the tiles that were listed last, and unmarks them.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/storage/subpixel/shared.h"

layout(local_size_x = 32) in;
layout(binding = 0, scalar) writeonly buffer Marked { uint marked[]; };
layout(binding = 1, scalar) readonly buffer Listed { SmallTiles tiles; uint listed[]; };
layout(binding = 2, scalar) writeonly buffer Kept { uint64_t kept[]; };
layout(push_constant, scalar) uniform Push { uvec2 size; };  // of the map

void main() {
  uint width = (size.x + small_tile - 1) / small_tile;
  for (uint i = gl_WorkGroupID.x; i < tiles.count; i += gl_NumWorkGroups.x) {
    uint tile = listed[i];
    uvec2 corner = uvec2(tile % width, tile / width) * small_tile;
    marked[tile] = 0;
    for (uint k = gl_LocalInvocationIndex; k < small_tile * small_tile; k += gl_WorkGroupSize.x) {
      uvec2 at = corner + uvec2(k % small_tile, k / small_tile);
      if (all(lessThan(at, size))) kept[at.y * size.x + at.x] = ~uint64_t(0);
    }
  }
}
