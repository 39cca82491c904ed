// Structs of visible.comp, for C++ and GLSL.
#ifndef SHADEWRIGHT_PERSPECTIVE_VISIBLE_H
#define SHADEWRIGHT_PERSPECTIVE_VISIBLE_H

#include "render/shared.h"

#ifdef __cplusplus
namespace shadewright::shared {
#endif

struct TileConstants {
  uint side;    // of a tile, pixels, even
  uvec2 tiles;  // columns and rows of them
  float light_cos_outer;
  vec3 light_position;
  vec3 light_direction;
};

/// What a tile of the image shows of what the light may reach: faces it, inside a spot's cone.
struct VisibleTile {
  float nearest, farthest;  // view depths; nearest above farthest where there is nothing
  float light_distance;     // the least distance to a light with a position, along the axis of the spot or of the face
  float depth;              // of the pixel in the tile's middle, 0 for background
  vec3 normal;              // there
  vec3 low, high;           // bounds, world
};

#ifdef __cplusplus
}  // namespace shadewright::shared
#endif
#endif
