// Every format but glTF, by assimp, into the common graph.
#pragma once

#include <string>
#include <vector>

#include "scene/scene_graph.h"
#include "shadewright/progress.h"

namespace shadewright {

/// Reads what assimp can. Files that say or imply that Z is up are turned to +Y up. Throws InputError.
SceneGraph read_with_assimp(const std::string& path, const Progress& progress, std::vector<std::string>& warnings);

}  // namespace shadewright
