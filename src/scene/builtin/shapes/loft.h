// The surface through a row of rings: what lathes, sweeps, balls and tubes have in common.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright::builtin {

/// A closed polygon in space; counter-clockwise seen from where the loft goes. A ring of one point is a pole.
using Ring = std::vector<glm::dvec3>;

enum class Ends {
  capped,  ///< flat caps; rings must be star-shaped about their centroid at the ends
  joined,  ///< the last ring joins the first, as in a torus
  open     ///< no caps: a sheet, for scenes that are not closed
};

/// Closed (unless `open`) and outward oriented. All rings have the same number of points, poles excepted; poles may
/// only be first or last. Two triangles a quad.
Mesh loft(std::span<const Ring> rings, Ends ends = Ends::capped);

}  // namespace shadewright::builtin
