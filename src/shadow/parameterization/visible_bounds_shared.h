// Structs of visible_bounds.comp, for C++ and GLSL.
#ifndef SHADEWRIGHT_SHADOW_VISIBLE_BOUNDS_SHARED_H
#define SHADEWRIGHT_SHADOW_VISIBLE_BOUNDS_SHARED_H

#include "render/shared.h"

#ifdef __cplusplus
namespace shadewright::shared {
#endif

const uint max_bounded_sets = 8;
/// An invocation looks at the pixels of a square of this side.
const int bounded_tile = 16;

/// A set of surface points, those of view depths from `nearest` to `farthest`, and the axes to bound it in.
struct BoundedSet {
  mat4x3 view_from_world;
  float max_tangent;  // 0: no perspective
  float nearest, farthest;
};

/// Floats as unsigned integers in the same order; low above high where nothing was seen.
struct OrderedBounds {
  uint low[3];
  uint high[3];
};

#ifdef __cplusplus
}  // namespace shadewright::shared
#endif
#endif
