// Lists the tiles in which there may be texels of small triangles, as a draw of six vertices an instance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/storage/subpixel/shared.h"

layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer Marked { uint marked[]; };
layout(binding = 1, scalar) buffer Listed { SmallTiles tiles; uint listed[]; };
layout(push_constant, scalar) uniform Push { uint tile_count; };

void main() {
  uint tile = gl_GlobalInvocationID.x;
  if (tile >= tile_count || marked[tile] == 0) return;
  listed[atomicAdd(tiles.count, 1)] = tile;
}
