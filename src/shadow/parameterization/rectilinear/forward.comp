// Forward analysis (the paper's section 4.1): importance of what the light's depth image shows, and where that has shadow edges,
// which backward samples ask for in hybrid analysis. One invocation a texel of the image.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shadow/map_point.glsl"
#include "shadow/receivers.glsl"
#include "shadow/parameterization/rectilinear/shared.h"
#include "shadow/parameterization/rectilinear/known.glsl"
#include "shadow/parameterization/rectilinear/importance.glsl"
#include "shadow/parameterization/rectilinear/accumulate.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 5, scalar) writeonly buffer Edges { uint edges[]; };
layout(set = 0, binding = 7) uniform sampler2DArray light_depth;

float depth_at(ivec2 texel) { return texelFetch(light_depth, ivec3(clamp(texel, ivec2(0), ivec2(constants.image_size - 1)), 0), 0).r; }

// Of two one-sided differences the smaller: that of the texel's own surface, where the other crosses an edge.
float own_slope(float before, float here, float after) {
  return abs(after - here) < abs(here - before) ? after - here : here - before;
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, ivec2(constants.image_size)))) return;
  float depth = depth_at(texel);
  vec2 slope = vec2(own_slope(depth_at(texel - ivec2(1, 0)), depth, depth_at(texel + ivec2(1, 0))),
                    own_slope(depth_at(texel - ivec2(0, 1)), depth, depth_at(texel + ivec2(0, 1))));
  // An edge is where a neighbour leaves the texel's own plane by more than a bias of one texel would allow: by its depth alone,
  // every grazing plane would be one.
  float bias = abs(slope.x) + abs(slope.y) + 1.0 / 65536.0;
  bool edge = false;
  for (int i = 0; i < 9; ++i) {
    ivec2 offset = ivec2(i % 3, i / 3) - 1;
    edge = edge || abs(depth_at(texel + offset) - depth - dot(slope, vec2(offset))) > bias;
  }
  edges[texel.y * constants.image_size + texel.x] = edge ? 1 : 0;
  if (constants.forward == 0 || depth >= 1.0) return;

  vec3 map = vec3((vec2(texel) + 0.5) / float(constants.image_size), depth);
  Receiver r;
  r.world = map_unproject_view(map_views[0], map.xy, depth);
  vec4 clip = camera.clip_from_relative * vec4(r.world - camera.eye, 1.0);
  bool in_view = clip.w > 0.0 && all(lessThanEqual(abs(clip.xy), vec2(clip.w)));
  if ((functions & importance_view) != 0 && !in_view) return;
  float step = 1.0 / float(constants.image_size);
  r.normal = normalize(cross(map_unproject_view(map_views[0], map.xy + vec2(step, 0.0), depth + slope.x) - r.world,
                             map_unproject_view(map_views[0], map.xy + vec2(0.0, step), depth + slope.y) - r.world));
  vec3 ray = light_kind() == light_directional ? lookup.light_direction : r.world - lookup.light_position;
  if (dot(r.normal, ray) > 0.0) r.normal = -r.normal;
  Orientation o = chosen_orientation();
  float view_depth = max(clip.w, camera_view_depth(camera, 1.0 - camera.background_depth));
  vec2 value = importance(camera, view_depth, r, map, o, constants);
  if ((functions & importance_edges) != 0) value *= edge ? 1.0 : constants.flat_weight;
  accumulate(texel, whole_of(o, map.xy), value, true);
}
