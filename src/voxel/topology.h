// Which triangles share an edge, and which connected components are closed bodies (CPVS, section 4 "Closed object
// optimization": the space inside them is undefined).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "casters.h"
#include "shadewright/voxel/bake.h"

namespace shadewright::voxel {

inline constexpr uint32_t kNoTriangle = ~0u;

struct Topology {
  /// Of edge e of triangle t (corner e to corner e + 1), at 3 t + e: the triangle that runs along it the other way, if
  /// the edge has exactly these two; else kNoTriangle.
  std::vector<uint32_t> neighbours;
  std::vector<uint8_t> closed;      ///< by triangle
  std::vector<uint32_t> component;  ///< by triangle: the lowest triangle of its component
  ComponentCounts components;
};

/// A component (joined by edges) is closed when every edge is run along as often one way as the other: its surface is a
/// cycle, which is what entry and exit counting needs; every oriented closed 2-manifold is one. Closed components that
/// are oriented inwards (a room), or that contain one of the scene's cameras, count as open. `mode` all or none
/// overrules everything.
Topology find_topology(const Casters& casters, const Scene& scene, ClosedMode mode);

}  // namespace shadewright::voxel
