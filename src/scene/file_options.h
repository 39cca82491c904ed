// What a user says about a file that the file itself does not tell: FILE?up=z&without=SkyBox,BB_*
#pragma once

#include <string>
#include <vector>

#include "scene/scene_graph.h"

namespace shadewright {

struct FileOptions {
  std::string path;
  bool z_up = false;                 ///< turn the file, +Z becomes +Y
  std::vector<std::string> without;  ///< names of nodes whose meshes to leave out; a final * stands for any ending
};

/// Splits `source`. A name that exists as it stands is a file without options. InputError names an unknown option.
FileOptions parse_file_options(const std::string& source);

/// Does to `graph` what `options` ask. InputError for a name in `without` that no node has.
void apply(const FileOptions& options, SceneGraph& graph);

}  // namespace shadewright
