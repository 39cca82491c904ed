// A flat polygon given thickness: gables, arches, brackets, leaves of iron. Closed, outward oriented.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright::builtin {

using Polygon = std::vector<glm::dvec2>;

/// Triangles of a simple polygon (counter-clockwise, may be concave, no three neighbours in one line), by clipping
/// ears.
std::vector<glm::uvec3> triangulate(std::span<const glm::dvec2> polygon);

/// The polygon in the plane of x and y, from z = `back` to z = `front`. `bevel` above 0 cuts the edges of both faces by
/// that many metres; it must be smaller than the polygon's features.
Mesh extrude(std::span<const glm::dvec2> polygon, double back, double front, double bevel = 0);

}  // namespace shadewright::builtin
