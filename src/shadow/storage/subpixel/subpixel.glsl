// subpixel: a texel keeps the triangle whose minimum depth in it is the least (SPSM 2014).
// The storage module of a look-up; needs a parameterization before it.
//
// A receiver before its texel's minimum depth, or on the texel's own plane, is lit; one behind the texel's or a neighbour's triangle is
// shadowed; of the others, the edges of the triangles around tell.
#include "shadow/storage/subpixel/occluder.glsl"
#include "shadow/storage/subpixel/silhouette.glsl"
#include "shadow/storage/subpixel/tangents.glsl"

#define STORAGE_DECISIONS 3  // so many ways to come to an answer, from 1 on; `storage_decision` tells which

// How the last receiver was decided (figure 14), by which of the 3x3 texels, and the nearest place of the shadow's border that recovery
// found, in texels from the receiver.
uint storage_decision;
int subpixel_decider;
vec2 subpixel_border;

const ivec2 subpixel_order[9] = ivec2[9](ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(-1, 0), ivec2(0, -1), ivec2(-1, 1),
                                         ivec2(1, -1), ivec2(-1, -1));

ivec2 subpixel_offset(int i) { return ivec2(i % 3, i / 3) - 1; }

// Whether there is a triangle in texel `i` of the 3x3 around `p`, whose own texel's centre is at `centre`.
bool subpixel_fetch(MapPoint p, vec2 centre, int i, out Occluder o) {
  ivec2 offset = subpixel_offset(i);
  ivec3 address;
  if (!map_fetch(p, offset, address)) return false;
  float minimum = texelFetch(subpixel_minimum, address, 0).r;
  if (minimum == 1.0) return false;
#ifdef MAP_WARPED
  p = map_in_frame_of(p, address.xy);
  centre = vec2(address.xy) + 0.5 - p.uv / p.texel - vec2(offset);
#endif
  o = occluder_at(address, centre + vec2(offset), minimum, p);
  return true;
}

bool subpixel_behind_silhouette(MapPoint p, vec2 centre) {
  Silhouette s = no_silhouette;
  uint occluded = 0;
  Occluder o;
  for (int i = 0; i < 9; ++i) {
    if (!subpixel_fetch(p, centre, i, o) || !occluder_before(o)) continue;
    silhouette_add(s, o);
    ++occluded;
  }
  subpixel_border = s.border;
  return silhouette_shadows(s, occluded == 9);
}

bool subpixel_behind_tangents(MapPoint p, vec2 centre) {
  uint pattern = 0;
  Occluder o;
  for (int i = 0; i < 9; ++i)
    if (subpixel_fetch(p, centre, i, o) && occluder_before(o)) pattern |= 1u << i;
  uint count = subpixel_tables.tangent_counts[pattern];
  subpixel_border = vec2(silhouette_none);
  if (count == tangents_lit || count == tangents_shadowed) return count == tangents_shadowed;
  float behind = 1e9;
  for (uint k = 0; k < count; ++k) {
    vec2 normal = subpixel_tables.tangents[4 * pattern + k];
    Border border = Border(1e9, vec2(-1e9, 0.0), vec2(1e9, 0.0));
    bool left_occluded = false, right_occluded = false;
    for (int i = 0; i < 9; ++i) {
      if ((pattern & (1u << i)) == 0 || !subpixel_fetch(p, centre, i, o)) continue;
      border_add(border, o, normal);
      float along = dot(vec2(subpixel_offset(i)), vec2(normal.y, -normal.x));
      if (along < -0.5) left_occluded = true;
      if (along > 0.5) right_occluded = true;
    }
    float behind_this = border_behind(border, left_occluded, right_occluded);
    if (behind_this < behind) subpixel_border = -behind_this * normal;
    behind = min(behind, behind_this);
  }
  return behind > 0.0;
}

float storage_visible(MapPoint p) {
  storage_decision = decided_by_one_texel;
  subpixel_decider = 4;
  ivec3 address;
  if (!p.valid || !map_fetch(p, ivec2(0), address)) return 1.0;
  if (texelFetch(subpixel_minimum, address, 0).r >= min(p.depth - lookup.bias_scale * p.tolerance, 1.0)) return 1.0;

  // The texel's own triangle first, then the neighbours', those on the receiver's side before the others.
  vec2 centre = vec2(address.xy) + 0.5 - p.uv / p.texel;  // of the texel, from the receiver
  ivec2 side = ivec2(centre.x < 0.0 ? 1 : -1, centre.y < 0.0 ? 1 : -1);
  Occluder o;
  for (int k = 0; k < 9; ++k) {
    ivec2 offset = subpixel_order[k] * side;
    int i = 3 * offset.y + offset.x + 4;
    if (!subpixel_fetch(p, centre, i, o)) continue;
    float error = occluder_error(o, vec2(0.0));
    if (k == 0 && !o.averted && abs(o.depth) <= error) return 1.0;
    if (o.depth < -error && occluder_holds(o, vec2(0.0))) {
      storage_decision = k == 0 ? decided_by_one_texel : decided_by_neighbours;
      subpixel_decider = i;
      return 0.0;
    }
  }
  storage_decision = decided_by_recovery;
  if (subpixel.recovery == recovery_off) {
    storage_decision = decided_by_neighbours;
    return 1.0;
  }
  bool behind = subpixel.recovery == recovery_tangents ? subpixel_behind_tangents(p, centre) : subpixel_behind_silhouette(p, centre);
  return behind ? 0.0 : 1.0;
}

// The nearest place of the shadow's border to the receiver of the last `storage_visible`, which answered `visible`: texels from it, far
// away where none is known.
vec2 storage_border(MapPoint p, float visible) {
  const vec2 none = vec2(silhouette_none);
  if (!p.valid) return none;
  if (storage_decision == decided_by_recovery) return subpixel_border;
  vec2 centre = 0.5 - fract(p.uv / p.texel), slope = p.gradient * p.texel;
  Occluder o;
  if (visible == 0.0) {
    // Under a triangle: its silhouettes, and where it passes through the receiver's plane.
    if (!subpixel_fetch(p, centre, subpixel_decider, o)) return none;
    vec2 border = -o.depth / max(dot(o.gradient, o.gradient), 1e-30) * o.gradient;
    for (uint i = 0; i < 3; ++i) {
      vec2 from, to, normal;
      if (decode_silhouette(o.words[i]) && occluder_edge(o, i, from, to, normal)) nearer(border, nearest_place(from, to));
    }
    return border;
  }
  float threshold = map_threshold(p);
  Silhouette s = no_silhouette;
  for (int i = 0; i < 9; ++i) {
    ivec2 offset = subpixel_offset(i);
    ivec3 address;
    if (map_fetch(p, offset, address) &&
        texelFetch(subpixel_minimum, address, 0).r < min(threshold + dot(centre + vec2(offset), slope), 1.0) &&
        subpixel_fetch(p, centre, i, o))
      silhouette_add(s, o);
  }
  return s.border;
}
