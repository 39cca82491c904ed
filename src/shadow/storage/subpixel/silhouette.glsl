// Silhouette recovery by known silhouettes, ours: each triangle tells which of its edges are silhouettes, so that a receiver that no
// triangle covers needs no guess at the border's direction. Beyond a silhouette, or where a surface passes through the
// receiver's plane, there is light; beyond any other edge the surface goes on, over a triangle that no texel kept.

struct Silhouette {
  vec2 border;  // the nearest place where a surface ends: texels from the receiver,
  float inner;  // and how far the nearest edge is, squared, beyond which one goes on towards the receiver
  uint ends, goes_on;  // how many silhouettes and how many such edges of closed bodies are turned towards the receiver
};
const float silhouette_none = 1e4;  // texels: out of sight
const Silhouette no_silhouette = Silhouette(vec2(silhouette_none), 4.0 * silhouette_none * silhouette_none, 0, 0);

vec2 nearest_place(vec2 from, vec2 to) {
  vec2 along = to - from;
  return from + clamp(-dot(from, along) / max(dot(along, along), 1e-12), 0.0, 1.0) * along;
}

void nearer(inout vec2 place, vec2 other) {
  if (dot(other, other) < dot(place, place)) place = other;
}

// Whether what goes on beyond an edge that is no silhouette may be taken to be before the receiver's plane still when it gets there from
// `place`. A closed body's averted side does until a silhouette. An open surface, whose parts no texel kept, may turn to any side, as the
// wall behind a ledge does: not where it would pass through the plane with this slope. Of the receivers on facades seen from afar that it would
// cover with a lesser one a fifth lay in shadow, with a greater one half of them.
const float steep_slope = 16.0;
bool reaches_receiver(Occluder o, vec2 place) { return o.averted || -occluder_depth(o, place) >= steep_slope * o.unit * length(place); }

// Adds a triangle's edges, and tells whether it lies before the receiver's plane anywhere in its texel.
bool silhouette_add(inout Silhouette s, Occluder o) {
  bool covers = o.depth < 0.0;  // its plane, at the receiver
  bool before = occluder_corner_before(o);
  vec2 first_crossing, second_crossing;
  uint crossing_count = 0;
  for (uint i = 0; i < 3; ++i, o = occluder_turned(o)) {
    vec2 from, to, outward, crossing;
    bool crosses;
    if (!occluder_edge(o, from, to, outward)) continue;
    before = before || occluder_edge_before(o, from, to);
    if (!occluder_clip(o, from, to, crossing, crosses)) continue;
    if (crosses) {
      if (crossing_count == 0) first_crossing = crossing;
      else second_crossing = crossing;
      ++crossing_count;
    }
    if (dot(outward, from) >= 0.0) continue;
    vec2 place = nearest_place(from, to);
    bool ends = decode_silhouette(o.words.x);
    if (ends) ++s.ends;
    if (covers && !ends && reaches_receiver(o, place)) {
      if (o.averted) ++s.goes_on;
      s.inner = min(s.inner, dot(place, place));
    } else {
      nearer(s.border, place);
    }
  }
  if (crossing_count == 2 && !covers) nearer(s.border, nearest_place(first_crossing, second_crossing));
  return before;
}

// Of neighbouring edges both end at the same place: a silhouette decides then. A surface that passes through the receiver's plane nearby ends
// nothing where all edges that look at the receiver go on. Where all nine texels are occluded bodies may be smaller than texels, and what
// covers the receiver is often not kept: the nearest edge tells little there, but how many of the edges are silhouettes does. Of such
// receivers of closed bodies most lay in shadow with up to two silhouettes for each other edge, and 10 to 30 % with silhouettes alone.
bool silhouette_shadows(Silhouette s, bool all_occluded) {
  if (s.inner < dot(s.border, s.border) - 1e-4) return true;
  return s.goes_on > 0 && s.ends == 0 || all_occluded && 2 * s.goes_on >= s.ends;
}
