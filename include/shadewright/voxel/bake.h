// Bakes the shadow of a light that never moves, cast by what never moves, into a voxel DAG (CPVS 2014: Sintorn, Kämpe,
// Olsson, Assarsson, "Compact Precomputed Voxelized Shadows").
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shadewright/geometry/box.h"
#include "shadewright/progress.h"
#include "shadewright/scene/scene.h"
#include "shadewright/voxel/info.h"
#include "shadewright/voxel/shadow.h"

namespace shadewright::voxel {

/// Whose inside is undefined: that of bodies found to be closed, of everything, of nothing.
enum class ClosedMode { automatic, all, none };

/// How undefined voxels get a value.
enum class Resolving {
  paper,   ///< section 6.1: by a node's other children
  stabbed  ///< as the height field, within the undefined ranges, that has the fewest and best aligned steps (default:
           ///< smaller)
};

struct BakeOptions {
  uint32_t resolution = 16384;           ///< voxels per axis: a power of two, 64 to 1,048,576
  std::optional<uint32_t> depth_voxels;  ///< voxels along z: a power of two, 64 to `resolution`; none = `resolution`
  ClosedMode closed = ClosedMode::automatic;
  bool static_receivers =
      false;                  ///< no dynamic receivers: what lies between the first and second surface is undefined too
  uint32_t max_filter = 9;    ///< largest filter that look-ups may use: odd, 1 to 17
  bool pyramid = false;       ///< also one DAG per lower power of two, for distant receivers (MRAA, section 5)
  std::optional<Box> bounds;  ///< world space: only this box needs shadows; none = the whole scene
  double memory_gigabytes = 8;  ///< FailureError rather than hold more than this in nodes and lists
  uint32_t threads = 0;         ///< 0 = all cores
  Resolving resolving = Resolving::stabbed;
};

struct ComponentCounts {
  uint64_t closed = 0;
  uint64_t open = 0;       ///< with borders, or edges that do not pair up
  uint64_t inwards = 0;    ///< closed but oriented inwards: counted as open
  uint64_t inhabited = 0;  ///< closed but with a camera inside: counted as open
  /// One sentence for each component of the last two sorts, up to ten.
  std::vector<std::string> notes;
};

struct StageSeconds {
  std::string name;
  double seconds = 0;
};

struct BakeStatistics {
  uint64_t triangles = 0;
  uint64_t moving_instances = 0;   ///< left out of the bake
  uint64_t clipped_triangles = 0;  ///< reached far out of the window or before a spot's near plane
  uint64_t silhouette_triangles = 0;
  uint64_t quads = 0, tiles = 0, stabbed_leaves = 0;  ///< visited by the recursion; rasterized; with more than one step
  ComponentCounts components;
  std::vector<LevelCounts> levels;  ///< of the full resolution
  std::vector<StageSeconds> stages;
  double seconds = 0;
  uint64_t peak_bytes = 0;  ///< of nodes, tables and lists, not of the scene itself
};

struct BakeResult {
  VoxelShadow shadow;
  BakeStatistics statistics;
};

/// Bakes `light` (directional or spot) over every instance without a motion. The bytes of the result depend on the
/// input alone, not on the number of threads. Throws InputError for options out of range, point lights and empty
/// scenes, FailureError when the memory bound is reached, and whatever `progress` throws to cancel.
BakeResult bake(const Scene& scene, const Light& light, const BakeOptions& options,
                const Progress& progress = no_progress);

/// The paper's own construction (section 6.1) from a map that comes from elsewhere: `depth` has resolution x resolution
/// texels, row by row, 0 at the near side of `grid`, 1 at the far side (or more: nothing hit). `exit`, if not empty, is
/// where the first undefined region ends (at least `depth`). Both as visibility asks them: voxel z is visible when (z +
/// 0.5) / N <= depth. `grid` says where the map lies in the world; its log2_depth must equal its log2_size.
VoxelShadow bake_depth_map(std::span<const float> depth, std::span<const float> exit, const LightGrid& grid,
                           uint32_t max_filter, const Progress& progress = no_progress);

}  // namespace shadewright::voxel
