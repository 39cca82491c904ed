// Silhouette recovery by tangents, the paper's (section 4.2, figures 7, 8 and 10): the pattern of occluded texels tells on which side
// the shadow's border lies, and the occluders' edges that look there are linked to a piecewise linear border.

#include "shadow/storage/subpixel/shared.h"

layout(set = SHADEWRIGHT_LOOKUP_SET, binding = 11, scalar) readonly buffer SubpixelTangentTable { SubpixelTangents subpixel_tangents; };

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
  for (uint i = 0; i < 3; ++i, o = occluder_turned(o)) {
    vec2 from, to, outward, crossing;
    bool crosses;
    if (!occluder_edge(o, from, to, outward) || dot(outward, normal) >= 0.0) continue;
    if (occluder_clip(o, from, to, crossing, crosses)) border_add_edge(border, from, to, normal);
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
