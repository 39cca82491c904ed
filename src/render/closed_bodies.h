// Which triangles of a mesh bound closed bodies.
#pragma once

#include <cstdint>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright::render {

/// By triangle: 1 where it belongs to a connected component that is closed and oriented outwards, so that whoever is
/// not inside sees only its counterclockwise sides.
std::vector<uint8_t> closed_triangles(const Mesh& mesh);

}  // namespace shadewright::render
