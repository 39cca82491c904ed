// What the batch look-up keeps of a block of points, lane by lane. Small enough for the first cache.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "shadewright/raytrace/tracer.h"

namespace shadewright::voxel {

inline constexpr size_t kBlockPoints = 256;
/// In place of a height: the point's visibility is known.
inline constexpr uint32_t kEnded = ~0u;
/// Leaves that a filter of 17 x 17 touches at most.
inline constexpr size_t kMostLeaves = 9;

/// `LightGrid::receiver_voxel` as numbers.
struct ReceiverMap {
  bool spot = false;
  std::array<std::array<double, 4>, 4> voxel{};  ///< rows of voxel_from_world
  std::array<std::array<double, 4>, 3> light{};  ///< rows of light_from_world, and 0
  std::array<double, 3> towards_light{};
  /// Offset for a light-space normal along an axis; metres; for spots at distance 1 along the axis (z: times its
  /// square).
  double reach_x = 0, reach_y = 0, reach_z = 0;
};

struct PointBlock {
  size_t count = 0;
  alignas(64) std::array<std::array<float, kBlockPoints>, 3> position, normal;
  alignas(64) std::array<std::array<uint32_t, kBlockPoints>, 3> voxel;
  alignas(64) std::array<uint32_t, kBlockPoints> at, height, value;

  /// Up to kBlockPoints; lanes behind them repeat the last point.
  void load(std::span<const SurfacePoint> points) {
    count = points.size();
    for (size_t i = 0; i < (count + 15) / 16 * 16; ++i) {
      const SurfacePoint& point = points[i < count ? i : count - 1];
      for (int axis = 0; axis < 3; ++axis) {
        position[size_t(axis)][i] = point.position[axis];
        normal[size_t(axis)][i] = point.normal[axis];
      }
    }
  }
};

struct LeafTasks {
  static constexpr size_t kSize = 512;
  size_t count = 0;
  alignas(64) std::array<uint32_t, kSize> x, y, z;             ///< the leaf's first texel, and its depth
  alignas(64) std::array<uint32_t, kSize> center_x, center_y;  ///< of the filter
  alignas(64) std::array<uint32_t, kSize> at, height, lit;
  std::array<uint32_t, kSize> point;
};

}  // namespace shadewright::voxel
