// The triangle of one texel of a sub-pixel shadow map, seen from a receiver. Needs a parameterization before it.
// Places are in texels from the receiver. Depths are counted from the receiver's plane: what is negative occludes.
#include "shadow/storage/subpixel/coverage.glsl"
#include "shadow/storage/subpixel/texel.glsl"

layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 2) uniform usampler2DArray subpixel_map;
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 3) uniform sampler2DArray subpixel_minimum;  // consistent minimum depth
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 4, scalar) uniform SubpixelSlopeTable { SubpixelSlopes subpixel_slopes; };
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 5, scalar) uniform SubpixelConstant { SubpixelConstants subpixel; };

struct Occluder {
  uvec3 words;
  bool large;
  bool averted;     // a closed body's side that looks away from the light: no receiver lies on it
  vec2 centre;      // of the texel
  float depth;      // of its plane at the receiver
  vec2 gradient;    // of that
  vec2 error;       // how far the gradient may be off,
  float tolerance;  // and the depth at the texel's centre
};

// `minimum` is the texel's, not 1.
Occluder occluder_at(ivec3 address, vec2 centre, float minimum, MapPoint p) {
  uvec4 texel = texelFetch(subpixel_map, address, 0);
  SlopeCoding coding = subpixel.coding;
  uint mark = (1 << coding.bits) - 1;
  uint code_x = texel.a >> (32 - coding.bits), code_y = (texel.a >> (32 - 2 * coding.bits)) & mark;
  Occluder o;
  o.words = texel.rgb;
  o.large = code_x == mark;
  o.centre = centre;
  o.averted = (texel.b >> 31) != 0;
  if (o.large) code_x = (texel.r >> 28) | ((texel.g >> 28) << 4) | (((texel.b >> 28) & 7) << 8);
  SlopeEntry x = subpixel_slopes.slopes[code_x], y = subpixel_slopes.slopes[code_y];
  float unit = map_slope_unit(p);
  float reach = depth_reach(x, y) * unit;
  float depth = coding.absolute_depth != 0 ? float(texel.a & 0xffffu) / 65535.0
                                           : minimum + reach * (float(texel.a & 0x3ffu) / 511.0 - 1.0);
  vec2 slope = unit * vec2(x.slope, y.slope);
  o.depth = depth - dot(centre, slope) - p.depth;  // equation 1
  o.gradient = slope - p.gradient * p.texel;
  o.error = lookup.bias_scale * unit * vec2(x.error, y.error);
  o.tolerance = lookup.bias_scale * (p.tolerance + (coding.absolute_depth != 0 ? 0.5 / 65535.0 : reach / 1022.0));
  return o;
}

// Whether `at` lies in the triangle's area.
bool occluder_holds(Occluder o, vec2 at) {
  at -= o.centre;
  if (o.large) {
    for (uint i = 0; i < 3; ++i) {
      vec3 line = decode_line(o.words[i]);
      if (dot(line.xy, at) > line.z) return false;
    }
    return true;
  }
  return in_triangle(at, decode_vertex(o.words.x), decode_vertex(o.words.y), decode_vertex(o.words.z));
}

float occluder_depth(Occluder o, vec2 at) { return o.depth + dot(o.gradient, at); }

// How far that may be off.
float occluder_error(Occluder o, vec2 at) { return o.tolerance + dot(o.error, abs(at - o.centre)); }

// One edge, as far as it is in sight (false: nothing of it is), and its normal out of the triangle, of any length.
bool occluder_edge(Occluder o, uint i, out vec2 from, out vec2 to, out vec2 normal) {
  if (o.large) {
    vec3 l = decode_line(o.words[i]);
    normal = l.xy;
    if (abs(l.z) >= line_reach - 1.0) return false;
    vec2 foot = l.xy * l.z, along = vec2(-l.y, l.x);
    float low = -line_reach, high = line_reach;
    for (uint k = 1; k < 3; ++k) {
      vec3 m = decode_line(o.words[(i + k) % 3]);
      float rate = dot(m.xy, along), room = m.z - dot(m.xy, foot);
      if (rate > 1e-6) high = min(high, room / rate);
      else if (rate < -1e-6) low = max(low, room / rate);
      else if (room < 0.0) return false;
    }
    from = o.centre + foot + low * along;
    to = o.centre + foot + high * along;
    return low < high;
  }
  vec2 a = decode_vertex(o.words[i]), b = decode_vertex(o.words[(i + 1) % 3]), c = decode_vertex(o.words[(i + 2) % 3]);
  normal = vec2(b.y - a.y, a.x - b.x);
  if (dot(normal, c - a) > 0.0) normal = -normal;
  from = o.centre + a;
  to = o.centre + b;
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

// Whether the triangle lies before the receiver's plane anywhere in its texel: figure 9's consistent depth, compared where it is.
bool occluder_before(Occluder o) {
  vec2 corner = o.centre - half_texel * vec2(o.gradient.x < 0.0 ? -1.0 : 1.0, o.gradient.y < 0.0 ? -1.0 : 1.0);
  if (occluder_depth(o, corner) < -occluder_error(o, corner) && occluder_holds(o, corner)) return true;
  for (uint i = 0; i < 3; ++i) {
    vec2 from, to, normal;
    if (!occluder_edge(o, i, from, to, normal)) continue;
    vec2 within = clip_to_texel(from - o.centre, to - o.centre);
    if (within.x > within.y) continue;
    vec2 a = mix(from, to, within.x), b = mix(from, to, within.y);
    if (occluder_depth(o, a) < -occluder_error(o, a) || occluder_depth(o, b) < -occluder_error(o, b)) return true;
  }
  return false;
}
