// Scenes from files: load_scene without the built-in ones.
#pragma once

#include "shadewright/scene/load.h"

namespace shadewright {

/// Reads the scene file `source`, with its options if it has any (file_options.h); warnings and errors as in
/// load_scene.
LoadedScene load_file(const std::string& source, const Progress& progress = no_progress);

}  // namespace shadewright
