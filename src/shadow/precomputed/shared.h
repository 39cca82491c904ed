// Structs of precomputed.glsl, for C++ and GLSL (scalar layout).
#ifndef SHADEWRIGHT_PRECOMPUTED_SHARED_H
#define SHADEWRIGHT_PRECOMPUTED_SHARED_H

#include "shadow/shared.h"

#ifdef __cplusplus
namespace shadewright::shared {
using glm::ivec3;
#endif

/// One DAG of the pyramid: word offsets of its parts.
struct DagPlace {
  uint grid, nodes, leaves;
  uint log2_size, log2_grid;
};

/// `LightGrid::receiver_voxel` as numbers, in the precision that the device is good at: GLSL names it `real`.
#ifdef __cplusplus
template <typename real, typename real4>
#endif
struct ReceiverRows {
  real4 voxel[4];                  // rows of voxel_from_world, for positions relative to `origin`
  real4 light[3];                  // rows of light_from_world
  real reach_x, reach_y, reach_z;  // receiver offset for a light-space normal along an axis (a spot: at distance 1)
  vec3 origin;                     // near the eye where `real` is float, so that near receivers are exact
  ivec3 base;                      // whole voxels at `origin`, left out of the rows
};

const uint max_dags = 16;

/// What the look-up needs besides the words, the rows and the light.
struct PrecomputedData {
  vec3 view_axis;    // unit
  float pixel_area;  // of a pixel at view depth 1, square metres
  vec2 texel_size;   // metres; a spot: at distance 1
  uint depth;        // voxels along z, of the finest DAG
  uint dag_count;
  DagPlace dags[max_dags];
};

#ifdef __cplusplus
/// The buffer at binding 0 of the look-up's set; one, for the reason told of LookupUniform.
struct PrecomputedUniform {
  LookupData lookup;
  PrecomputedData precomputed;
};
}  // namespace shadewright::shared
#endif
#endif
