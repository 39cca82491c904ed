// The triangle of one texel of a sub-pixel shadow map, seen from a receiver. Needs a parameterization before it.
// Places are in texels from the receiver. Depths are counted from the receiver's plane: what is negative occludes.
#include "shadow/storage/subpixel/coverage.glsl"
#include "shadow/storage/subpixel/texel.glsl"

layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 8) uniform usampler2DArray subpixel_map;
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 9) uniform sampler2DArray subpixel_minimum;  // consistent minimum depth
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 10, scalar) uniform SubpixelSlopeTable { SubpixelSlopes subpixel_slopes; };

struct Occluder {
  uvec3 words;
  vec3 a, b, c;     // its vertices, or of a large one the lines through its edges (as decode_line), from the texel's centre
  bool large;
  bool averted;     // a closed body's side that looks away from the light: no receiver lies on it
  vec2 centre;      // of the texel
  float depth;      // of its plane at the receiver
  vec2 gradient;    // of that
  vec2 error;       // how far the gradient may be off,
  float tolerance;  // and the depth at the texel's centre
  float unit;       // map depth of a texel's width along the light
};

// `minimum` is the texel's, not 1.
Occluder occluder_at(ivec3 address, vec2 centre, float minimum, MapPoint p) {
  uvec4 texel = texelFetch(subpixel_map, address, 0);
  SlopeCoding coding = lookup.slope_coding;
  uint mark = (1 << coding.bits) - 1;
  uint code_x = texel.a >> (32 - coding.bits), code_y = (texel.a >> (32 - 2 * coding.bits)) & mark;
  Occluder o;
  o.words = texel.rgb;
  o.large = code_x == mark;
  o.centre = centre;
  o.averted = (texel.b >> 31) != 0;
  if (o.large) {
    o.a = decode_line(o.words.x);
    o.b = decode_line(o.words.y);
    o.c = decode_line(o.words.z);
  } else {
    o.a = vec3(decode_vertex(o.words.x), 0.0);
    o.b = vec3(decode_vertex(o.words.y), 0.0);
    o.c = vec3(decode_vertex(o.words.z), 0.0);
  }
  if (o.large) code_x = (texel.r >> 28) | ((texel.g >> 28) << 4) | (((texel.b >> 28) & 7) << 8);
  SlopeEntry x = subpixel_slopes.slopes[code_x], y = subpixel_slopes.slopes[code_y];
  float unit = map_slope_unit(p);
  float reach = depth_reach(x, y) * unit;
  float depth = coding.absolute_depth != 0 ? float(texel.a & 0xffffu) / 65535.0
                                           : minimum + reach * (float(texel.a & 0x3ffu) / 511.0 - 1.0);
  vec2 slope = unit * vec2(x.slope, y.slope);
  o.unit = unit;
  o.depth = depth - dot(centre, slope) - p.depth;  // equation 1
  o.gradient = slope - p.gradient * p.texel;
  o.error = lookup.bias_scale * unit * vec2(x.error, y.error);
  o.tolerance = lookup.bias_scale * (p.tolerance + (coding.absolute_depth != 0 ? 0.5 / 65535.0 : reach / 1022.0));
  return o;
}

bool within_line(vec3 line, vec2 at) { return dot(line.xy, at) <= line.z; }

// Whether `at` lies in the triangle's area.
bool occluder_holds(Occluder o, vec2 at) {
  at -= o.centre;
  return o.large ? within_line(o.a, at) && within_line(o.b, at) && within_line(o.c, at) : in_triangle(at, o.a.xy, o.b.xy, o.c.xy);
}

float occluder_depth(Occluder o, vec2 at) { return o.depth + dot(o.gradient, at); }

// How far that may be off.
float occluder_error(Occluder o, vec2 at) { return o.tolerance + dot(o.error, abs(at - o.centre)); }

// The same with the next edge first. Edges are walked so, not by an index: no CPU device finds a vertex by index in a register.
Occluder occluder_turned(Occluder o) {
  o.words = o.words.yzx;
  vec3 first = o.a;
  o.a = o.b;
  o.b = o.c;
  o.c = first;
  return o;
}

// Cuts off of the line from `foot` along `along` what lies beyond another.
void cut_line(inout vec2 part, vec3 other, vec2 foot, vec2 along) {
  float rate = dot(other.xy, along), room = other.z - dot(other.xy, foot);
  if (rate > 1e-6) part.y = min(part.y, room / rate);
  else if (rate < -1e-6) part.x = max(part.x, room / rate);
  else if (room < 0.0) part.y = part.x;
}

// The first edge, as far as it is in sight (false: nothing of it is), and its normal out of the triangle, of any length.
bool occluder_edge(Occluder o, out vec2 from, out vec2 to, out vec2 normal) {
  if (o.large) {
    normal = o.a.xy;
    vec2 foot = o.a.xy * o.a.z, along = vec2(-o.a.y, o.a.x), part = vec2(-line_reach, line_reach);
    cut_line(part, o.b, foot, along);
    cut_line(part, o.c, foot, along);
    from = o.centre + foot + part.x * along;
    to = o.centre + foot + part.y * along;
    return abs(o.a.z) < line_reach - 1.0 && part.x < part.y;
  }
  normal = vec2(o.b.y - o.a.y, o.a.x - o.b.x);
  if (dot(normal, o.c.xy - o.a.xy) > 0.0) normal = -normal;
  from = o.centre + o.a.xy;
  to = o.centre + o.b.xy;
  return true;
}

// Leaves of an edge what lies before the receiver's plane. `crossing` is where it passes through, if it does.
// False where nothing is left.
bool occluder_clip(Occluder o, inout vec2 from, inout vec2 to, out vec2 crossing, out bool crosses) {
  float depth_from = occluder_depth(o, from), depth_to = occluder_depth(o, to);
  crosses = (depth_from < 0.0) != (depth_to < 0.0);
  if (crosses) {
    crossing = mix(from, to, depth_from / (depth_from - depth_to));
    if (depth_from >= 0.0) from = crossing;
    else to = crossing;
  }
  return crosses || depth_from < 0.0;
}

// Whether the triangle lies before the receiver's plane anywhere in its texel (figure 9's consistent depth, compared where it is):
// at the texel's own lowest corner, or on an edge.
bool occluder_before_at(Occluder o, vec2 at) { return occluder_depth(o, at) < -occluder_error(o, at); }
bool occluder_corner_before(Occluder o) {
  vec2 corner = o.centre - half_texel * vec2(o.gradient.x < 0.0 ? -1.0 : 1.0, o.gradient.y < 0.0 ? -1.0 : 1.0);
  return occluder_before_at(o, corner) && occluder_holds(o, corner);
}
bool occluder_edge_before(Occluder o, vec2 from, vec2 to) {
  vec2 within = clip_to_texel(from - o.centre, to - o.centre);
  return within.x <= within.y &&
         (occluder_before_at(o, mix(from, to, within.x)) || occluder_before_at(o, mix(from, to, within.y)));
}
bool occluder_before(Occluder o) {
  bool before = occluder_corner_before(o);
  for (uint i = 0; i < 3; ++i, o = occluder_turned(o)) {
    vec2 from, to, normal;
    before = before || occluder_edge(o, from, to, normal) && occluder_edge_before(o, from, to);
  }
  return before;
}
