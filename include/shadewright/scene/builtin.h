// The built-in scenes: procedural, seeded, the same bytes everywhere. They stand for the papers' own (scenes.md).
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright {

/// A parameter of a built-in scene, given as "builtin:NAME?key=value".
struct BuiltinParameter {
  std::string key;
  std::string help;
  double default_value = 0, min = 0, max = 0;
};

using BuiltinValues = std::map<std::string, double, std::less<>>;

struct BuiltinScene {
  std::string name;
  std::string help;  ///< one line: what it shows, which paper's figure it stands for
  std::vector<BuiltinParameter> parameters;
  std::function<Scene(const BuiltinValues&)> make;  ///< gets a value for every parameter, in range
};

/// All of them, by name.
std::span<const BuiltinScene> builtin_scenes();

/// Builds "NAME[?key=value&...]" (without the "builtin:" prefix). InputError names unknown scenes, keys and values out
/// of range, and lists what there is.
Scene make_builtin(std::string_view name_and_query);

}  // namespace shadewright
