// subpixel: a texel keeps the triangle whose minimum depth in it is the least (SPSM 2014).
// The storage module of a look-up; needs a parameterization before it.
//
// A receiver before its texel's minimum depth, or on the texel's own plane, is lit; one behind the texel's or a neighbour's triangle is
// shadowed; of the others, the edges of the triangles around tell.
#include "shadow/storage/subpixel/occluder.glsl"
#include "shadow/storage/subpixel/silhouette.glsl"
#include "shadow/storage/subpixel/tangents.glsl"

#define STORAGE_PASSES 1

// LookupData::recovery + 1 where it is known when the look-up is compiled, which leaves the other way out.
layout(constant_id = 2) const uint known_recovery = 0;
uint subpixel_recovery() { return known_recovery == 0 ? lookup.recovery : known_recovery - 1; }

// How the last receiver was decided (figure 14), by which of the 3x3 texels, and the nearest place of the shadow's border that recovery
// found, in texels from the receiver.
uint storage_decision;
int subpixel_decider;
vec2 subpixel_border;
bool subpixel_border_known;

const ivec2 subpixel_order[8] =
    ivec2[8](ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(-1, 0), ivec2(0, -1), ivec2(-1, 1), ivec2(1, -1), ivec2(-1, -1));

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

bool subpixel_behind_tangents(MapPoint p, vec2 centre) {
  uint pattern = 0;
  Occluder o;
  for (int i = 0; i < 9; ++i)
    if (subpixel_fetch(p, centre, i, o) && occluder_before(o)) pattern |= 1u << i;
  uint count = subpixel_tangents.tangent_counts[pattern];
  subpixel_border = vec2(silhouette_none);
  subpixel_border_known = true;
  if (count == tangents_lit || count == tangents_shadowed) return count == tangents_shadowed;
  float behind = 1e9;
  for (uint k = 0; k < count; ++k) {
    vec2 normal = subpixel_tangents.tangents[4 * pattern + k];
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

// The centre of the texel in which the receiver lies, from the receiver.
vec2 subpixel_centre(MapPoint p) { return vec2(map_texel(p)) + 0.5 - p.uv / p.texel; }

// Whether the receiver's own texel holds nothing before it, which one depth tells. False: see storage_texel.
bool storage_lit(MapPoint p) {
  storage_decision = decided_by_one_texel;
  subpixel_decider = 4;
  ivec3 address;
  if (!p.valid || !map_fetch(p, ivec2(0), address)) return true;
  return texelFetch(subpixel_minimum, address, 0).r >= min(p.depth - lookup.bias_scale * p.tolerance, 1.0);
}

// What the triangle of that texel decides. False: its neighbours have a say, see storage_near.
bool storage_texel(MapPoint p, out float visible) {
  storage_decision = decided_by_one_texel;
  subpixel_decider = 4;
  visible = 1.0;
  Occluder o;
  subpixel_fetch(p, subpixel_centre(p), 4, o);
  float error = occluder_error(o, vec2(0.0));
  if (!o.averted && abs(o.depth) <= error) return true;
  visible = 0.0;
  return o.depth < -error && occluder_holds(o, vec2(0.0));
}

// Both.
bool storage_quick(MapPoint p, out float visible) {
  visible = 1.0;
  return storage_lit(p) || storage_texel(p, visible);
}

// What the neighbours' triangles decide where storage_quick could not. False: see storage_recover.
bool storage_near(MapPoint p, out float visible) {
  storage_decision = decided_by_neighbours;
  visible = 0.0;
  vec2 centre = subpixel_centre(p);
  ivec2 side = ivec2(centre.x < 0.0 ? 1 : -1, centre.y < 0.0 ? 1 : -1);  // those on the receiver's side before the others
  Occluder o;
  for (int k = 0; k < 8; ++k) {
    ivec2 offset = subpixel_order[k] * side;
    subpixel_decider = 3 * offset.y + offset.x + 4;
    if (subpixel_fetch(p, centre, subpixel_decider, o) && o.depth < -occluder_error(o, vec2(0.0)) && occluder_holds(o, vec2(0.0)))
      return true;
  }
  visible = 1.0;
  return subpixel_recovery() == recovery_off;
}

// Whether anything in texel `i` may lie before the receiver's plane.
bool subpixel_candidate(MapPoint p, vec2 centre, int i) {
  ivec2 offset = subpixel_offset(i);
  ivec3 address;
  if (!map_fetch(p, offset, address)) return false;
  float farthest = 1.0;
#ifndef MAP_WARPED
  vec2 slope = p.gradient * p.texel;
  farthest = min(farthest, p.depth + dot(centre + vec2(offset), slope) + half_texel * (abs(slope.x) + abs(slope.y)));
#endif
  return texelFetch(subpixel_minimum, address, 0).r < farthest;
}

// Whether a texel around holds what lies before the receiver's plane there, wherever in the texel.
bool subpixel_before(MapPoint p, vec2 centre, ivec2 offset) {
  ivec3 address;
  return map_fetch(p, offset, address) && texelFetch(subpixel_minimum, address, 0).r <
                                              min(map_threshold(p) + dot(centre + vec2(offset), p.gradient * p.texel), 1.0);
}

// The same of all sixteen texels around the 3x3. What casts so wide a shadow is thick or lies in many layers: of receivers among nothing but
// silhouettes that it surrounds 55 to 90 % are shadowed, of others 10 to 35 %.
bool subpixel_surrounded(MapPoint p, vec2 centre) {
  bool surrounded = true;
  for (int k = -2; k < 2 && surrounded; ++k)
    surrounded = subpixel_before(p, centre, ivec2(k, -2)) && subpixel_before(p, centre, ivec2(2, k)) &&
                 subpixel_before(p, centre, ivec2(-k, 2)) && subpixel_before(p, centre, ivec2(-2, -k));
  return surrounded;
}

// What covers the receiver touches its texel: where that holds nothing before the plane, and few of the others do, there is light. Where
// more do, as at contacts, the texel may have kept what reaches below the plane instead.
bool subpixel_behind_silhouettes(MapPoint p, vec2 centre) {
  const int own = 4, few = 2;
  bool touched;
  int occluded = 0;
  uint candidates = 0;
  for (int i = 0; i < 9; ++i)
    if (subpixel_candidate(p, centre, i)) candidates |= 1u << i;
  Silhouette s = no_silhouette;
  Occluder o;
  subpixel_border_known = false;
  for (int i = own; candidates != 0; i = findLSB(candidates)) {
    Silhouette more = s;
    bool before = subpixel_fetch(p, centre, i, o) && silhouette_add(more, o);
    candidates &= ~(1u << i);
    if (i == own) touched = before;
    if (before) {
      s = more;
      ++occluded;
    }
    if (!touched && occluded + bitCount(candidates) <= few) return false;
  }
  subpixel_border_known = true;
  subpixel_border = s.border;
  return silhouette_shadows(s, occluded == 9) || occluded == 9 && subpixel_surrounded(p, centre);
}

// What is left to the edges of the triangles around where storage_near could not tell.
float storage_recover(MapPoint p) {
  storage_decision = decided_by_recovery;
  vec2 centre = subpixel_centre(p);
  bool behind = subpixel_recovery() == recovery_tangents ? subpixel_behind_tangents(p, centre) : subpixel_behind_silhouettes(p, centre);
  return behind ? 0.0 : 1.0;
}

float storage_visible(MapPoint p) {
  float visible;
  return storage_quick(p, visible) || storage_near(p, visible) ? visible : storage_recover(p);
}

// The nearest place of the shadow's border to the receiver of the last look-up: texels from it, far away where none is known.
// Under a triangle: its silhouettes, and where it passes through the receiver's plane.
vec2 subpixel_border_under(Occluder o) {
  vec2 border = -o.depth / max(dot(o.gradient, o.gradient), 1e-30) * o.gradient;
  for (uint i = 0; i < 3; ++i, o = occluder_turned(o)) {
    vec2 from, to, normal;
    if (decode_silhouette(o.words.x) && occluder_edge(o, from, to, normal)) nearer(border, nearest_place(from, to));
  }
  return border;
}

// After storage_quick, which answered `visible`. False: storage_border must look farther.
bool storage_quick_border(MapPoint p, float visible, out vec2 border) {
  border = vec2(silhouette_none);
  if (!p.valid) return true;
  vec2 centre = 0.5 - fract(p.uv / p.texel);
  bool before = false;
  for (int i = 0; i < 9; ++i) before = before || subpixel_before(p, centre, subpixel_offset(i));
  Occluder o;
  if (visible == 0.0 && subpixel_fetch(p, centre, 4, o)) border = subpixel_border_under(o);
  return visible == 0.0 || !before;
}

// The same after storage_visible.
vec2 storage_border(MapPoint p, float visible) {
  const vec2 none = vec2(silhouette_none);
  if (!p.valid) return none;
  if (storage_decision == decided_by_recovery && subpixel_border_known) return subpixel_border;
  vec2 centre = 0.5 - fract(p.uv / p.texel);
  Occluder o;
  if (visible == 0.0) return subpixel_fetch(p, centre, subpixel_decider, o) ? subpixel_border_under(o) : none;
  Silhouette s = no_silhouette;
  for (int i = 0; i < 9; ++i)
    if (subpixel_before(p, centre, subpixel_offset(i)) && subpixel_fetch(p, centre, i, o)) silhouette_add(s, o);
  return s.border;
}
