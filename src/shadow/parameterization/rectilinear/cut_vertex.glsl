// Vertices of casters that are cut into the warp's segments (cut.comp): in a segment along u and one along v the warp is linear, so
// triangles stay triangles. What leaves the segments is clipped. Their borders lie between texels: no centre is near a cut.
#include "render/scene_vertex.glsl"
#include "shadow/parameterization/rectilinear/shared.h"

// The segments come with the piece: to look them up a vertex at a time took a fifth of a frame on a CPU device.
layout(location = 6) in vec4 piece_segment_u;
layout(location = 7) in vec4 piece_segment_v;

// Of what is not cut: vertices are warped where they lie, the edges between them straight.
layout(constant_id = 4) const bool warps_vertices = false;

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[4];
};

// Where the warp puts a flat coordinate, times w. `segment` as in PieceSegments.
float caster_axis(uint axis, vec4 segment, float x, float w) {
  float warped = segment.y * w + segment.z * (x - segment.x * w);
  gl_ClipDistance[2 * axis] = warped - segment.y * w;
  gl_ClipDistance[2 * axis + 1] = segment.w * w - warped;
  return warped;
}

vec4 caster_position(uint view) {
  vec4 p = map_caster_flat(scene_world_position(), view);
  if (warps_vertices) {
    for (int i = 0; i < 4; ++i) gl_ClipDistance[i] = 1.0;
    return map_caster_clip(p);
  }
  vec2 warped = vec2(caster_axis(0, piece_segment_u, p.x, p.w), caster_axis(1, piece_segment_v, p.y, p.w));
  return vec4(2.0 * warped - p.w, p.zw);
}
