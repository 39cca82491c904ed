// The cascades of a look-up, for C++ and GLSL (scalar layout).
#ifndef SHADEWRIGHT_CASCADED_SHARED_H
#define SHADEWRIGHT_CASCADED_SHARED_H

#include "render/shared.h"

#ifdef __cplusplus
namespace shadewright::shared {
#endif

const uint max_cascades = 8;

/// A cascade's map in the light's plane: (u w, v w) = turn * (x, y) + offset * w, see CascadeData.
struct CascadeWindow {
  mat2 turn;
  vec2 offset;
  vec2 border;  // uv: how near to the map's edge a receiver may lie, so that no filter reads beyond
};

/// All cascades share the light's axis and one range of depth, so that a receiver is projected once:
/// (x, y, depth w, w) = light_from_world * (world, 1), x and y metres across the light (of a spot light, times its
/// distance).
struct CascadeData {
  mat4 light_from_world;
  mat4 world_from_light;
  CascadeWindow windows[max_cascades];  // finest first; one that holds nothing has a border of the whole map
};

#ifdef __cplusplus
}  // namespace shadewright::shared
#endif
#endif
