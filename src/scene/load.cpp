// One door for every source of scenes.
#include "shadewright/scene/load.h"

#include "scene/load_file.h"
#include "shadewright/scene/builtin.h"

namespace shadewright {

LoadedScene load_scene(const std::string& source, const Progress& progress) {
  constexpr std::string_view builtin_prefix = "builtin:";
  if (!source.starts_with(builtin_prefix)) return load_file(source, progress);
  progress("load", 0.0);
  LoadedScene loaded{make_builtin(std::string_view(source).substr(builtin_prefix.size())), {}};
  progress("load", 1.0);
  return loaded;
}

}  // namespace shadewright
