// The casters on a fixed grid of 1/256 voxel, as integers: every later decision is exact (formulas.md "Same bytes
// everywhere").
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "casters.h"
#include "shadewright/voxel/light_grid.h"
#include "topology.h"

namespace shadewright::voxel {

inline constexpr int32_t kSubVoxels = 256;
/// Snapped coordinates stay within this, so that edge functions (products of two differences, added) stay within 63
/// bits.
inline constexpr int32_t kGuard = 1 << 29;

/// What a ray along z does when it meets a triangle of this kind.
enum class Crossing : int8_t { leaves = -1, open = 0, enters = 1 };

/// Corners in order of increasing angle (positive area in (x, y)), whatever the facing was.
struct SnappedTriangle {
  glm::ivec3 corners[3];  ///< sub-voxels
  Crossing crossing = Crossing::open;
  /// Bit e: edge e (corner e to e + 1) may border the sheet that the triangle belongs to.
  uint8_t silhouettes = 0;
};

struct SnappedCasters {
  std::vector<SnappedTriangle> triangles;  ///< those that have an area and touch the window
  uint64_t clipped = 0, silhouette = 0;    ///< triangles
};

/// Facing is decided after snapping, by integer area. An edge does not border a sheet only if both its triangles face
/// the same way, share their kind, and were not clipped. Triangles beyond the guard or before a spot's near plane are
/// clipped; a closed component that the near plane cuts counts as open.
SnappedCasters snap(const Casters& casters, const Topology& topology, const LightGrid& grid);

}  // namespace shadewright::voxel
