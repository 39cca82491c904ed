// A baked shadow, and its look-up: is a point of the world visible from the light, and how much of a filter around it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shadewright/raytrace/tracer.h"
#include "shadewright/voxel/dag.h"
#include "shadewright/voxel/light_grid.h"

namespace shadewright::voxel {

/// What a look-up must know beside the DAGs.
struct ShadowProperties {
  LightGrid light;
  uint32_t max_filter = 1;        ///< larger filters are refused: they could read undefined voxels
  int32_t filter_margin = 0;      ///< voxels of z kept defined before the end of each undefined region
  bool static_receivers = false;  ///< only points of the static scene's surfaces may be asked for
  bool all_closed = false;        ///< informational: no open triangle was baked
};

/// How receivers are looked up whose pixel covers more texels than the filter (CPVS, section 5).
enum class Distant {
  mraa,  ///< filtered in the DAG of a lower resolution; needs BakeOptions::pyramid
  voaa   ///< by the occupancy of a node as large as the pixel, interpolated between two heights
};

/// Immutable and cheap to copy (copies share the data). All members are thread-safe.
class VoxelShadow {
 public:
  VoxelShadow() = default;
  /// `dags[L]` has 2^(n - L) voxels per axis; [0] always exists, more are the MRAA pyramid. `owner` keeps their memory
  /// alive.
  VoxelShadow(const ShadowProperties& properties, std::vector<DagView> dags,
              std::vector<std::vector<uint64_t>> level_starts, std::shared_ptr<const void> owner);

  const ShadowProperties& properties() const { return properties_; }
  const LightGrid& light() const { return properties_.light; }
  std::span<const DagView> dags() const { return dags_; }
  /// Offsets in `dags()[level].nodes` where each height's nodes begin, from below the grid down to height 3, and the
  /// end.
  std::span<const uint64_t> level_starts(size_t level) const { return level_starts_[level]; }
  /// The same shadow in a world that was moved by `by`; shares the data.
  VoxelShadow moved(const glm::dvec3& by) const;
  /// Bytes of nodes and leaves of all DAGs, and of their grids.
  uint64_t dag_bytes() const;
  uint64_t grid_bytes() const;

  /// One voxel. Outside in x and y and before the volume: visible; behind it: the last voxel.
  bool visible(const glm::ivec3& voxel) const;
  /// Mean of taps x taps voxels of one depth around `voxel`; `taps` is odd, at most `max_filter` (else InputError).
  float filtered(const glm::ivec3& voxel, uint32_t taps) const;

  /// For each world point the mean visibility (0..1) of `taps` x `taps` voxels around the receiver, moved along its
  /// normal by `LightGrid::receiver_offset`. A zero normal moves it towards the light. `result` is as long as `points`.
  /// Points outside the window or beside a spot light are visible. Points are floats: far from the world's zero, ask
  /// the shadow `moved` by minus a place nearby for points relative to that place. Uses all cores (oneTBB) and the
  /// CPU's widest vectors (Highway); the results are the same everywhere. InputError if `taps` is even, or larger than
  /// `max_filter`.
  void visibility(std::span<const SurfacePoint> points, uint32_t taps, std::span<float> result) const;

  /// As `visibility`, for points each of whose pixels has a footprint of `footprints[i]` metres (the square root of its
  /// area). With a = footprint in texels: MRAA filters at level max(0, floor(log2(a / taps))) of the pyramid;
  /// VOAA takes over where a > taps, at nodes of side a / 2. Both move the receiver towards the light by
  /// `LightGrid::distant_receiver`: held against ray tracing, a finer level and that way halve the paper's error.
  /// InputError as for `visibility`, and for MRAA without a pyramid.
  void distant_visibility(std::span<const SurfacePoint> points, std::span<const float> footprints, uint32_t taps,
                          Distant how, std::span<float> result) const;

 private:
  void check_taps(uint32_t taps) const;

  ShadowProperties properties_;
  std::vector<DagView> dags_;
  std::vector<std::vector<uint64_t>> level_starts_;
  std::shared_ptr<const void> owner_;
};

}  // namespace shadewright::voxel
