// glTF 2.0 into the common graph. Read here rather than by assimp, whose 5.2.5 follows damaged glTF out of bounds,
// rounds node transforms to float and forgets which accessors meshes share.
#pragma once

#include <string>
#include <vector>

#include "scene/scene_graph.h"
#include "shadewright/progress.h"

namespace shadewright {

/// Reads a .gltf or .glb. Throws InputError.
SceneGraph read_gltf(const std::string& path, const Progress& progress, std::vector<std::string>& warnings);

}  // namespace shadewright
