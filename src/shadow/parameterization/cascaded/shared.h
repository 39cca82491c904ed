// The cascades of a look-up, for C++ and GLSL (scalar layout).
#ifndef SHADEWRIGHT_CASCADED_SHARED_H
#define SHADEWRIGHT_CASCADED_SHARED_H

#include "render/shared.h"

#ifdef __cplusplus
namespace shadewright::shared {
#endif

const uint max_cascades = 8;

struct CascadeData {
  uint count;
  vec2 border[max_cascades];  // uv: how near to the map's edge a receiver may lie, so that no filter reads beyond
};

#ifdef __cplusplus
}  // namespace shadewright::shared
#endif
#endif
