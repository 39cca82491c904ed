// Structs of reduce.comp, for C++ and GLSL.
#ifndef SHADEWRIGHT_UNIFORM_REDUCE_H
#define SHADEWRIGHT_UNIFORM_REDUCE_H

#include "render/shared.h"

#ifdef __cplusplus
namespace shadewright::shared {
#endif

struct LightAxes {
  mat4x3 view_from_world;
  float max_tangent;  // 0: directional
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
