// A curved sheet over a grid, with cells left out: one layer of triangles, open, for scenes that are deliberately not
// closed.
#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "shadewright/scene/scene.h"

namespace shadewright::builtin {

/// The points position(i, j) of a (columns + 1) x (rows + 1) grid; cells where keep(i, j) is false are left out, and
/// their vertices with them. The front is where i runs right and j runs up.
Mesh sheet(uint32_t columns, uint32_t rows, const std::function<glm::dvec3(uint32_t, uint32_t)>& position,
           const std::function<bool(uint32_t, uint32_t)>& keep);

}  // namespace shadewright::builtin
