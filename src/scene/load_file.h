// Scenes from files: load_scene without the built-in ones.
#pragma once

#include "shadewright/scene/load.h"

namespace shadewright {

/// Reads the scene file at `path`; warnings and errors as in load_scene.
LoadedScene load_file(const std::string& path, const Progress& progress = no_progress);

}  // namespace shadewright
