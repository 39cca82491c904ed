// A cross-section carried along a curve without twisting (double reflection frames, Wang et al. 2008): ropes, rails,
// branches, hairs, limbs. Closed, outward oriented.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/builtin/shapes/loft.h"
#include "shadewright/scene/scene.h"

namespace shadewright::builtin {

using Path = std::vector<glm::dvec3>;

/// The size of the cross-section at each point of the path: factors along its own x and y. Zero makes a tip (ends
/// only).
using Sizes = std::vector<glm::dvec2>;

/// `section`: counter-clockwise points about the origin. Its y axis starts as close to `up` as it can and is carried
/// along. `sizes` has one entry per point of the path.
Mesh sweep(std::span<const glm::dvec2> section, std::span<const glm::dvec3> path, std::span<const glm::dvec2> sizes,
           const glm::dvec3& up = {0, 1, 0}, Ends ends = Ends::capped);

/// A regular polygon of radius 1.
std::vector<glm::dvec2> regular_polygon(uint32_t sides);

/// A round tube of one radius.
Mesh tube(std::span<const glm::dvec3> path, double radius, uint32_t sides, Ends ends = Ends::capped);
/// A round tube whose radius goes linearly from `radius` to `end_radius` along the path's points.
Mesh tapered_tube(std::span<const glm::dvec3> path, double radius, double end_radius, uint32_t sides);
/// A straight round bar.
Mesh rod(const glm::dvec3& a, const glm::dvec3& b, double radius, uint32_t sides);

/// Catmull-Rom through `points`, `steps` spans between neighbours.
Path smooth_path(std::span<const glm::dvec3> points, uint32_t steps);

}  // namespace shadewright::builtin
