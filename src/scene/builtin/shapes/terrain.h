// A height field over a rectangle, closed into a solid: top, skirt and bottom.
#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "shadewright/scene/scene.h"

namespace shadewright::builtin {

/// Heights at (columns + 1) x (rows + 1) grid points between `min` and `max` (x and z); the bottom is flat at `bottom`,
/// below every height. 2 columns rows + 6 (columns + rows) triangles.
Mesh terrain_solid(const glm::dvec2& min, const glm::dvec2& max, uint32_t columns, uint32_t rows, double bottom,
                   const std::function<double(double x, double z)>& height);

/// The top alone: a sheet.
Mesh terrain_sheet(const glm::dvec2& min, const glm::dvec2& max, uint32_t columns, uint32_t rows,
                   const std::function<double(double x, double z)>& height);

}  // namespace shadewright::builtin
