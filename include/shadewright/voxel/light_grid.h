// Where a point of the world falls in the voxel volume of a light: a uniform grid in the light's clip space (CPVS,
// section 3).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "shadewright/scene/scene.h"

namespace shadewright::voxel {

/// Voxel (x, y, z) covers [x, x + 1) x [y, y + 1) x [z, z + 1) of voxel space; z grows away from the light. Spot
/// lights: z is the normalized device depth, times the number of voxels.
struct LightGrid {
  LightKind kind = LightKind::directional;
  uint32_t log2_size = 0;   ///< n: 2^n texels in x and y
  uint32_t log2_depth = 0;  ///< d <= n: 2^d voxels in z
  glm::dmat4 voxel_from_world{
      1.0};  ///< homogeneous; w = 1 for directional lights, the distance along the axis for spots
  glm::dmat3 light_from_world{
      1.0};                    ///< rotation: rows are the world directions of texel x, texel y, and away from the light
  glm::dvec2 texel_size{1.0};  ///< directional: metres; spot: metres at distance 1
  double voxel_depth = 1;      ///< directional: metres of a voxel in z
  double near = 0, far = 0;    ///< spot: distances along the axis where z is 0 and 2^d

  uint32_t size() const { return 1u << log2_size; }
  uint32_t depth() const { return 1u << log2_depth; }

  /// The way light travels (a spot: along its axis), world space, unit length.
  glm::dvec3 direction() const { return glm::transpose(light_from_world)[2]; }
  /// Towards the light at a world point, unit length.
  glm::dvec3 towards_light(const glm::dvec3& world) const;
  /// Where a spot light stands, world space.
  glm::dvec3 position() const;
  /// Metres of a voxel in z; of a spot, at distance 1 along its axis, growing with the distance's square.
  double depth_at_unit_distance() const;

  /// Voxel coordinates of a world point (not finite, or w <= 0, for points beside or behind a spot light).
  glm::dvec3 voxel(const glm::dvec3& world) const;
  /// World extents of a voxel at a world point, metres.
  glm::dvec3 voxel_extent(const glm::dvec3& world) const;
  /// How far a receiver moves along its normal so that no tap of a `taps` x `taps` filter at its depth reaches below
  /// its own plane: taps/2 (tx |nx| + ty |ny|) + tz/2 |nz| with the light-space normal, and 1/32 voxel more for what
  /// snapping and float positions take. Metres. A zero normal means "towards the light".
  double receiver_offset(const glm::dvec3& world, const glm::dvec3& normal, uint32_t taps) const;
  /// `world` moved by `receiver_offset` (towards the light for a zero normal), in voxel coordinates.
  glm::dvec3 receiver_voxel(const glm::dvec3& world, const glm::dvec3& normal, uint32_t taps) const;
  /// Where a receiver whose pixel covers many texels is looked up: moved towards the light until nothing within
  /// `half_width` voxels along x and y lies below its own plane (at grazing light, a cosine below 0.1, no farther). So
  /// wide an offset along the normal would move the shadow's edge. A zero normal: stays. World space.
  glm::dvec3 distant_receiver(const glm::dvec3& world, const glm::dvec3& normal, double half_width) const;
  /// How deep a surface through a world point falls from column to column: voxels of depth a voxel along x and y (at
  /// grazing light, a cosine below 0.1, no more than there).
  glm::dvec2 plane_slope(const glm::dvec3& world, const glm::dvec3& normal) const;
  /// The last node of side 2^height in the column of `at` (voxel coordinates) that ends before a plane through `at`
  /// comes nearest in that column, in nodes: what a receiver looks up (VOAA, section 5) that is not to shade itself,
  /// where the paper moves it by half a node. z may be negative: before all.
  static glm::ivec3 clear_node(const glm::dvec3& at, const glm::dvec2& slope, uint32_t height);
  /// The same in a world that was moved by `by`.
  LightGrid moved(const glm::dvec3& by) const;
  /// The same window with half as many voxels on every axis.
  LightGrid halved() const;
};

}  // namespace shadewright::voxel
