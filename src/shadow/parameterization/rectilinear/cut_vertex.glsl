// Vertices of casters that are cut into the warp's segments (cut.comp): in a segment along u and one along v the warp is linear, so
// triangles stay triangles. What leaves the segments is clipped. Their borders lie between texels: no centre is near a cut.
#include "render/scene_vertex.glsl"
#include "shadow/parameterization/rectilinear/shared.h"

layout(location = 6) in uint caster_segments;

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[4];
};

vec4 caster_position(uint view) {
  vec4 p = map_caster_flat(scene_world_position(), view);
  for (int i = 0; i < 4; ++i) gl_ClipDistance[i] = 1.0;
  if (caster_segments == uncut) return map_caster_clip(p);
  uvec2 segment = uvec2(caster_segments & 0xffffu, caster_segments >> 16);
  vec2 warped;  // times w
  for (uint axis = 0; axis < 2; ++axis) {
    WarpSegment s = warp_segments[axis * warp.cells + segment[axis]];
    warped[axis] = s.start * p.w + s.slope * (p[axis] - s.flat_start * p.w);
    gl_ClipDistance[2 * axis] = warped[axis] - s.start * p.w;
    gl_ClipDistance[2 * axis + 1] = segment_end(axis, segment[axis]) * p.w - warped[axis];
  }
  return vec4(2.0 * warped - p.w, p.zw);
}
