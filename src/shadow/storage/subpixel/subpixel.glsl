// subpixel: a texel keeps the triangle whose minimum depth in it is the least (SPSM 2014).
// The storage module of a look-up; needs a parameterization before it.
//
// A receiver on the texel's own plane is lit; one behind the texel's or a neighbour's triangle is shadowed; of the others, the
// pattern of occluded texels around tells on which side the shadow's border lies, and the edges of their triangles where.
#include "shadow/storage/subpixel/coverage.glsl"
#include "shadow/storage/subpixel/texel.glsl"

layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 2) uniform usampler2DArray subpixel_map;
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 3) uniform sampler2DArray subpixel_minimum;  // consistent minimum depth
layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 4, scalar) readonly buffer SubpixelTable { SubpixelTables subpixel_tables; };

// How the last receiver was decided (figure 14).
const uint decided_by_one_texel = 1, decided_by_neighbours = 2, decided_by_recovery = 3;
uint subpixel_decision;

// The triangle of one texel. Places are relative to the receiver, in texels.
struct Occluder {
  uvec3 words;
  bool large;
  vec2 centre;
  float depth;      // of its plane at the receiver
  float tolerance;  // how far that may be off
};

Occluder occluder_at(ivec3 address, vec2 centre, float minimum, MapPoint p) {
  uvec4 texel = texelFetch(subpixel_map, address, 0);
  SlopeCoding coding = subpixel_tables.coding;
  uint mark = (1 << coding.bits) - 1;
  uint code_x = texel.a >> (32 - coding.bits), code_y = (texel.a >> (32 - 2 * coding.bits)) & mark;
  Occluder o;
  o.words = texel.rgb;
  o.large = code_x == mark;
  o.centre = centre;
  if (o.large) code_x = (texel.r >> 28) | ((texel.g >> 28) << 4) | ((texel.b >> 28) << 8);
  SlopeEntry x = subpixel_tables.slopes[code_x], y = subpixel_tables.slopes[code_y];
  float unit = map_views[p.layer].slope_unit;
  float reach = depth_reach(x, y) * unit;
  float depth = coding.absolute_depth != 0 ? float(texel.a & 0xffffu) / 65535.0
                                           : minimum + reach * (float(texel.a & 0x3ffu) / 511.0 - 1.0);
  float step = coding.absolute_depth != 0 ? 0.5 / 65535.0 : reach / 1022.0;
  o.depth = depth - unit * (centre.x * x.slope + centre.y * y.slope);  // equation 1
  o.tolerance = step + unit * (abs(centre.x) * x.error + abs(centre.y) * y.error);
  return o;
}

// Whether the receiver lies behind the triangle's area (algorithm 1), seen from the light.
bool occluder_covers(Occluder o) {
  if (o.large) {
    for (uint i = 0; i < 3; ++i) {
      vec3 line = decode_line(o.words[i]);
      if (dot(line.xy, -o.centre) > line.z) return false;
    }
    return true;
  }
  return in_triangle(-o.centre, decode_vertex(o.words.x), decode_vertex(o.words.y), decode_vertex(o.words.z));
}

// The border of the shadow along one tangent, as piecewise linear as the occluders' edges are: how deep in the shadow it lies,
// at the receiver, and the nearest of its vertices to both sides.
struct Border {
  float spanning;     // least depth of an edge that spans the receiver
  vec2 left, right;   // along the tangent, into the shadow
};

void border_add_edge(inout Border border, vec2 from, vec2 to, vec2 normal) {
  vec2 tangent = vec2(normal.y, -normal.x);
  vec2 a = vec2(dot(from, tangent), dot(from, normal)), b = vec2(dot(to, tangent), dot(to, normal));
  if (a.x > b.x) {
    vec2 swap = a;
    a = b;
    b = swap;
  }
  if (a.x <= 0.0 && b.x >= 0.0) {
    float depth = b.x - a.x < 1e-6 ? min(a.y, b.y) : mix(a.y, b.y, -a.x / (b.x - a.x));
    border.spanning = min(border.spanning, depth);
  } else if (b.x < 0.0) {
    if (b.x > border.left.x || (b.x == border.left.x && b.y < border.left.y)) border.left = b;
  } else {
    if (a.x < border.right.x || (a.x == border.right.x && a.y < border.right.y)) border.right = a;
  }
}

// Adds the edges of `o` that look towards the light's side of the border.
void border_add(inout Border border, Occluder o, vec2 normal) {
  if (o.large) {
    vec3 lines[3] = vec3[3](decode_line(o.words.x), decode_line(o.words.y), decode_line(o.words.z));
    for (uint i = 0; i < 3; ++i) {
      vec3 l = lines[i];
      if (dot(l.xy, normal) >= 0.0 || abs(l.z) >= line_reach - 1.0) continue;
      // The line's part within the other two, and within sight.
      vec2 foot = l.xy * l.z, along = vec2(-l.y, l.x);
      float from = -line_reach, to = line_reach;
      for (uint k = 1; k < 3; ++k) {
        vec3 m = lines[(i + k) % 3];
        float rate = dot(m.xy, along), room = m.z - dot(m.xy, foot);
        if (rate > 1e-6) to = min(to, room / rate);
        else if (rate < -1e-6) from = max(from, room / rate);
        else if (room < 0.0) to = -line_reach - 1.0;
      }
      if (from < to) border_add_edge(border, o.centre + foot + from * along, o.centre + foot + to * along, normal);
    }
    return;
  }
  vec2 v[3] = vec2[3](decode_vertex(o.words.x), decode_vertex(o.words.y), decode_vertex(o.words.z));
  float area = cross2(v[1] - v[0], v[2] - v[0]);
  for (uint i = 0; i < 3; ++i) {
    vec2 from = v[i], to = v[(i + 1) % 3], edge = to - from;
    if (dot(vec2(edge.y, -edge.x), normal) * area < 0.0) border_add_edge(border, o.centre + from, o.centre + to, normal);
  }
}

// How far behind the border the receiver lies, in texels: positive is shadowed.
float border_behind(Border border, bool left_occluded, bool right_occluded) {
  const float none = 1e9;
  if (border.spanning < none) return -border.spanning;
  bool left = border.left.x > -none, right = border.right.x < none;
  if (left && right) return -mix(border.left.y, border.right.y, border.left.x / (border.left.x - border.right.x));
  if (left && right_occluded) return -border.left.y;
  if (right && left_occluded) return -border.right.y;
  return -none;
}

float storage_visible(MapPoint p) {
  subpixel_decision = decided_by_one_texel;
  ivec3 address;
  if (!p.valid || !map_fetch(p, ivec2(0), address)) return 1.0;
  float tolerance = lookup.bias_scale * p.tolerance;
  float minimum = texelFetch(subpixel_minimum, address, 0).r;
  if (minimum >= p.depth - tolerance || minimum == 1.0) return 1.0;

  vec2 centre = vec2(address.xy) + 0.5 - p.uv / p.texel;  // of the texel, from the receiver
  vec2 slope = p.gradient * p.texel;
  float slack = 0.5 * (abs(slope.x) + abs(slope.y)) + tolerance;
  float least[9];
  uint pattern = 0, nearer = 0;
  for (int i = 0; i < 9; ++i) {
    ivec2 offset = ivec2(i % 3, i / 3) - 1;
    ivec3 at;
    least[i] = map_fetch(p, offset, at) ? texelFetch(subpixel_minimum, at, 0).r : 1.0;
    if (least[i] < 1.0 && least[i] < p.depth + dot(centre + vec2(offset), slope) - slack) pattern |= 1u << i;
    if (least[i] < min(p.depth - tolerance, 1.0)) nearer |= 1u << i;
  }
  uint count = subpixel_tables.tangent_counts[pattern];

  // The texel's own triangle first, then its neighbours'.
  for (int k = 4; k < 13; ++k) {
    int i = k % 9;
    if ((nearer & (1u << i)) == 0) continue;
    ivec2 offset = ivec2(i % 3, i / 3) - 1;
    ivec3 at;
    map_fetch(p, offset, at);
    Occluder o = occluder_at(at, centre + vec2(offset), least[i], p);
    float own = tolerance + lookup.bias_scale * o.tolerance;
    if (i == 4 && abs(o.depth - p.depth) <= own) return 1.0;
    if (o.depth < p.depth - own && occluder_covers(o)) return 0.0;
    if (count == tangents_shadowed && subpixel_tables.recovery != 0) return 0.0;
    subpixel_decision = decided_by_neighbours;
  }
  if (count == tangents_lit || subpixel_tables.recovery == 0) return 1.0;
  subpixel_decision = decided_by_recovery;
  float behind = 1e9;
  for (uint k = 0; k < count; ++k) {
    vec2 normal = subpixel_tables.tangents[4 * pattern + k];
    Border border = Border(1e9, vec2(-1e9, 0.0), vec2(1e9, 0.0));
    bool left_occluded = false, right_occluded = false;
    for (int i = 0; i < 9; ++i) {
      if ((pattern & (1u << i)) == 0) continue;
      ivec2 offset = ivec2(i % 3, i / 3) - 1;
      ivec3 at;
      map_fetch(p, offset, at);
      Occluder o = occluder_at(at, centre + vec2(offset), least[i], p);
      border_add(border, o, normal);
      float along = dot(vec2(offset), vec2(normal.y, -normal.x));
      if (along < -0.5) left_occluded = true;
      if (along > 0.5) right_occluded = true;
    }
    behind = min(behind, border_behind(border, left_occluded, right_occluded));
  }
  return behind > 0.0 ? 0.0 : 1.0;
}
