// The tiles that small_tiles.comp listed.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/map_point.glsl"
#include "shadow/storage/subpixel/shared.h"

layout(set = 0, binding = 0, scalar) readonly buffer Listed { SmallTiles tiles; uint listed[]; };

void main() {
  uint width = (uint(lookup.map_size.x) + small_tile - 1) / small_tile, tile = listed[gl_InstanceIndex];
  uvec2 corner = uvec2(gl_VertexIndex == 1 || gl_VertexIndex == 4 || gl_VertexIndex == 5,
                       gl_VertexIndex == 2 || gl_VertexIndex == 3 || gl_VertexIndex == 5);
  vec2 at = vec2((uvec2(tile % width, tile / width) + corner) * small_tile);
  gl_Position = vec4(2.0 * at / lookup.map_size - 1.0, 0.0, 1.0);
}
