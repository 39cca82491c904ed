// What the camera sees that faces the light, tile by tile: the range of view depths, and one surface point. One thread
// a tile: barriers cost a CPU device more than the pixels do.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#define SHADEWRIGHT_LOADS_FIRST 1
#include "render/camera.glsl"
#include "render/octahedral.glsl"
#include "shadow/loads_first.glsl"
#include "shadow/parameterization/perspective/visible.h"
#include "shadow/shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, scalar) SHADEWRIGHT_UNIFORM(CameraData, camera, load_camera)
layout(binding = 1) uniform sampler2D camera_depth;
layout(binding = 2) uniform sampler2D camera_normal;
#include "shadow/parameterization/camera_quad.glsl"
layout(binding = 3, scalar) writeonly buffer Tiles { VisibleTile tiles[]; };
layout(push_constant, scalar) uniform Push { TileConstants pushed; };
layout(constant_id = 0) const uint light_kind = light_directional;

TileConstants constants;
// What the look-up calls facing must not be missed for the order of its arithmetic.
const float facing_slack = 1e-4;
// Of this thread's pixels: depths as the camera's buffer has them, and bounds in the world.
const float infinity = 1.0 / 0.0;
float depth_low = infinity, depth_high = -infinity, light_low = infinity;
vec3 low = vec3(infinity), high = vec3(-infinity);

// No branches: a CPU device runs both sides of them anyway, and keeps book of the lanes.
void take(ivec2 pixel, float depth, vec2 encoded_normal) {
  vec3 normal = octahedral_direction(encoded_normal);
  vec3 world = camera_surface(camera, pixel, depth);
  bool counts = depth != camera.background_depth;
  if (light_kind == light_directional) {
    counts = counts && dot(normal, constants.light_direction) <= facing_slack;
  } else {
    vec3 from_light = world - constants.light_position;
    float away = length(from_light);
    counts = counts && dot(normal, from_light) <= facing_slack * away;
    // Along the axis of the map that it falls into.
    vec3 a = abs(from_light);
    float along = light_kind == light_point ? max(a.x, max(a.y, a.z)) : dot(from_light, constants.light_direction);
    if (light_kind == light_spot) counts = counts && along >= constants.light_cos_outer * away;
    light_low = min(light_low, counts ? along : infinity);
  }
  depth_low = min(depth_low, counts ? depth : infinity);
  depth_high = max(depth_high, counts ? depth : -infinity);
  low = min(low, counts ? world : vec3(infinity));
  high = max(high, counts ? world : vec3(-infinity));
}

void main() {
  load_camera();
  constants = pushed;
  if (any(greaterThanEqual(gl_GlobalInvocationID.xy, constants.tiles))) return;
  ivec2 first = ivec2(gl_GlobalInvocationID.xy * constants.side);
  ivec2 end = min(first + int(constants.side), ivec2(camera.size));
  for (int y = first.y; y < end.y; y += 2)
    for (int x = first.x; x < end.x; x += 2) {
      ivec2 quad = ivec2(x, y);
      vec2 corner = quad_corner(quad);
      vec4 depths = camera_quad(quad);
      if (depths == vec4(camera.background_depth)) continue;
      vec4 nx = textureGather(camera_normal, corner, 0), ny = textureGather(camera_normal, corner, 1);
      for (int k = 0; k < 4; ++k) take(quad + quad_pixels[k], depths[k], vec2(nx[k], ny[k]));
    }
  VisibleTile tile;
  bool any = depth_low <= depth_high;
  // Which depth is nearer depends on the camera's convention.
  float a = camera_view_depth(camera, depth_low), b = camera_view_depth(camera, depth_high);
  tile.nearest = any ? min(a, b) : 1.0;
  tile.farthest = any ? max(a, b) : 0.0;
  tile.light_distance = light_low;
  tile.low = low;
  tile.high = high;
  ivec2 middle = (first + end) / 2;
  float depth = texelFetch(camera_depth, middle, 0).r;
  tile.depth = depth == camera.background_depth ? 0.0 : camera_view_depth(camera, depth);
  tile.normal = octahedral_decode(texelFetch(camera_normal, middle, 0).rg);
  tiles[gl_GlobalInvocationID.y * constants.tiles.x + gl_GlobalInvocationID.x] = tile;
}
