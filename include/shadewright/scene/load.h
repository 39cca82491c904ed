// Scenes from files and by name, and back to GLB.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "shadewright/progress.h"
#include "shadewright/scene/scene.h"

namespace shadewright {

/// A scene with what a person should be told about how it was read (dropped triangles, masked materials drawn opaque,
/// ...).
struct LoadedScene {
  Scene scene;
  std::vector<std::string> warnings;  ///< one sentence each
};

/// Reads `source`: a file (glTF, GLB, OBJ, anything assimp reads; Z-up files are turned) or
/// "builtin:NAME[?key=value&...]". A file's name may be followed by what the file does not tell: "FILE?up=z" turns one
/// that is Z-up without saying so, "FILE?without=SkyBox,BB_*" leaves out the meshes of those nodes (not what hangs
/// below them). Shared geometry stays shared, node transforms are composed in double. Throws InputError, one sentence,
/// for anything that is missing, empty, truncated, not a scene, or without triangles.
LoadedScene load_scene(const std::string& source, const Progress& progress = no_progress);

/// Writes `scene` as a binary glTF that loads back to the same geometry, cameras and lights (KHR_lights_punctual),
/// rigid motions as node animations. Written beside and renamed: on failure nothing is left. Throws FailureError.
void write_glb(const Scene& scene, const std::filesystem::path& file);

}  // namespace shadewright
