// Internal helper of recentre, drop_degenerate_triangles and the readers.
#pragma once

#include "shadewright/scene/scene.h"

namespace shadewright {

/// Removes positions that no triangle refers to; the order of the others stays. All indices must be in range.
void drop_unused_vertices(Mesh& mesh);

}  // namespace shadewright
