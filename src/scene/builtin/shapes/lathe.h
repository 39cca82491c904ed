// Surfaces of revolution about +Y, and the common ones by name. All closed and outward oriented.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright::builtin {

/// A profile of (radius, height), in the order in which the surface's outside lies to the right of it: up the outside,
/// and for a hollow body over the rim and down the inside. Radius 0 at an end makes a pole, anything else a flat cap.
using Profile = std::vector<glm::dvec2>;

Mesh lathe(std::span<const glm::dvec2> profile, uint32_t segments);
/// The profile is a loop (counter-clockwise in radius, height; radius above 0): rings, pipes, tyres.
Mesh lathe_ring(std::span<const glm::dvec2> profile, uint32_t segments);

/// A smooth profile: Catmull-Rom through `points`, `steps` spans between neighbours; ends are kept. Radii are kept >=
/// 0.
Profile smooth(std::span<const glm::dvec2> points, uint32_t steps);

/// Centre at the origin.
Mesh sphere(double radius, uint32_t segments, uint32_t rings);
/// Stands on y = 0.
Mesh cylinder(double radius, double height, uint32_t segments);
/// Stands on y = 0; `top_radius` 0 makes a tip.
Mesh cone(double radius, double top_radius, double height, uint32_t segments);
/// Lies in the plane y = 0 about the origin.
Mesh torus(double radius, double tube_radius, uint32_t segments, uint32_t sides);
/// Stands on y = 0, hollow all the way through.
Mesh pipe(double inner_radius, double outer_radius, double height, uint32_t segments);

}  // namespace shadewright::builtin
