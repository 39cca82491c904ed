// What the camera sees, tile by tile: the range of view depths, and one surface point. One work group a tile.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "render/camera.glsl"
#include "render/octahedral.glsl"
#include "shadow/parameterization/perspective/visible.h"
#include "shadow/shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) uniform Camera { CameraData camera; };
layout(binding = 1) uniform sampler2D camera_depth;
layout(binding = 2) uniform sampler2D camera_normal;
layout(binding = 3, scalar) writeonly buffer Tiles { VisibleTile tiles[]; };
layout(push_constant, scalar) uniform Push { TileConstants constants; };

shared uint nearest, farthest, light_distance;

// Distance from the light along the axis of its map; negative for what a spot does not reach.
float axis_distance(vec3 world) {
  vec3 from_light = world - constants.light_position;
  if (constants.light_kind == light_point) {
    vec3 a = abs(from_light);
    return max(a.x, max(a.y, a.z));
  }
  float along = dot(from_light, constants.light_direction);
  return along >= constants.light_cos_outer * length(from_light) ? along : -1.0;
}

void main() {
  if (gl_LocalInvocationIndex == 0) {
    nearest = light_distance = ~0u;
    farthest = 0u;
  }
  barrier();
  ivec2 first = ivec2(gl_WorkGroupID.xy * constants.side);
  ivec2 end = min(first + int(constants.side), ivec2(camera.size));
  float low = 1.0 / 0.0, high = 0.0, light_low = 1.0 / 0.0;
  for (int y = first.y + int(gl_LocalInvocationID.y); y < end.y; y += 8)
    for (int x = first.x + int(gl_LocalInvocationID.x); x < end.x; x += 8) {
      float depth = texelFetch(camera_depth, ivec2(x, y), 0).r;
      if (depth == camera.background_depth) continue;
      float view_depth = camera_view_depth(camera, depth);
      if (constants.light_kind != light_directional) {
        float along = axis_distance(camera_surface(camera, ivec2(x, y), depth));
        if (along < 0.0) continue;
        light_low = min(light_low, along);
      }
      low = min(low, view_depth);
      high = max(high, view_depth);
    }
  // Positive floats are in the order of their bits.
  if (high > 0.0) {
    atomicMin(nearest, floatBitsToUint(low));
    atomicMax(farthest, floatBitsToUint(high));
    atomicMin(light_distance, floatBitsToUint(light_low));
  }
  barrier();
  if (gl_LocalInvocationIndex != 0) return;
  VisibleTile tile;
  bool any = farthest != 0u;
  tile.nearest = any ? uintBitsToFloat(nearest) : 1.0;
  tile.farthest = any ? uintBitsToFloat(farthest) : 0.0;
  ivec2 middle = (first + end) / 2;
  tile.light_distance = uintBitsToFloat(light_distance);
  float depth = texelFetch(camera_depth, middle, 0).r;
  tile.depth = depth == camera.background_depth ? 0.0 : camera_view_depth(camera, depth);
  tile.normal = octahedral_decode(texelFetch(camera_normal, middle, 0).rg);
  tiles[gl_WorkGroupID.y * constants.columns + gl_WorkGroupID.x] = tile;
}
