// Structs of the look-up that C++ and GLSL share (scalar layout).
#ifndef SHADEWRIGHT_SHADOW_SHARED_H
#define SHADEWRIGHT_SHADOW_SHARED_H

#include "render/shared.h"

#ifdef __cplusplus
namespace shadewright::shared {
#endif

/// One view of a shadow map: a layer drawn through one matrix. Map space: u, v in [0, 1] over the layer, v down, and
/// depth in [0, 1] growing away from the light.
struct MapViewData {
  mat4 map_from_world;  // (u w, v w, depth w, w)
  mat4 world_from_map;
  uint drawn;        // 0: nothing receives in this view, and its layer is not even cleared
  float slope_unit;  // map depth that a texel's width along the light makes, in the middle of the map
};
const uint max_map_views = 8;

const uint light_directional = 0, light_spot = 1, light_point = 2, light_any = 3;

/// How a sub-pixel map codes slopes and depth. `exponent` is the paper's n.
struct SlopeCoding {
  uint bits;            // of one slope: 8 or 11
  float exponent;       // of the power function of the angle; 1 is linear
  uint absolute_depth;  // 1: 16 bits over the map's whole range; 0: 10 bits within the texel, from the minimum depth on
};

/// What every look-up needs besides its maps, and what storages and filters add to it.
struct LookupData {
  vec3 light_position;
  vec3 light_direction;  // the way light travels
  float light_cos_outer;
  uint light_kind;
  vec3 eye;
  float bias_scale;
  vec2 map_size;             // texels
  float pcf_radius;          // half width of the box in texels, or
  float pcf_width;           // half width in metres; 0 = in texels
  float light_bleeding;      // of moments: the share of light that counts as none
  int triangle_reach;        // of triangle: texels to each side whose triangles are tested
  SlopeCoding slope_coding;  // of subpixel
  uint recovery;             // of subpixel: of receivers that no triangle covers (recovery_off, ...)
};

#ifdef __cplusplus
/// The buffer at binding 0 of a look-up's set. With those of the camera and of a parameterization it makes three: of a
/// fourth one, Mesa 22.3's lavapipe writes what conditions read beyond the end of an array, and crashes sooner or
/// later.
struct LookupUniform {
  LookupData lookup;
  MapViewData map_views[max_map_views];
};
#endif

/// Rows of the image that a pass over receivers works on at once: what it writes for all rows of a large image is more
/// than a storage binding holds.
struct ReceiverStrip {
  uint first_row;
  uint rows;
};

/// A look-up writes so many pixels of a row at once, a byte each of a word; a row takes `answer_words` of them.
const int answers_a_word = 4;
#ifdef __cplusplus
inline
#endif
    int
    answer_words(int width) {
  return (width + answers_a_word - 1) / answers_a_word;
}

/// The receivers whose answer a look-up puts off to a further pass. Their pixels follow, x and y in 16 bits each.
struct DeferredReceivers {
  uvec3 groups;  // of that pass
  uint count;
};
const uint deferred_group = 64, max_lookup_passes = 4;

/// Of caster_sides.comp: four bits a triangle, three of silhouette edges below this one.
const uint side_drawn = 8, sides_per_word = 8;
struct SidesConstants {
  uint cluster_count;
  uint list_capacity;
  uint view;
  uint compact;  // 1: list what is drawn
};

#ifdef __cplusplus
}  // namespace shadewright::shared
#endif
#endif
