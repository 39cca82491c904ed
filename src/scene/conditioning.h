// Internal helper of recentre, drop_degenerate_triangles and the readers.
#pragma once

#include "shadewright/scene/scene.h"

namespace shadewright {

/// True when the triangle is finite and its float normal, computed free of overflow and underflow, is not zero.
bool has_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Removes positions that no triangle refers to; the order of the others stays. All indices must be in range.
void drop_unused_vertices(Mesh& mesh);

}  // namespace shadewright
