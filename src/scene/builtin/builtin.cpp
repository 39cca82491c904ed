// The registry of built-in scenes, and the reading of "NAME?key=value&key=value".
#include "shadewright/scene/builtin.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "scene/builtin/scenes.h"
#include "shadewright/error.h"

namespace shadewright {
namespace {

std::vector<BuiltinScene> all_scenes() {
  std::vector<BuiltinScene> scenes = {
      builtin::characters(), builtin::chess(),      builtin::city(),  builtin::ecosystem(), builtin::furball(),
      builtin::landscape(),  builtin::lattice(),    builtin::ruins(), builtin::sandbox(),   builtin::spheres(),
      builtin::street(),     builtin::playground(), builtin::town(),  builtin::trees(),
  };
  std::sort(scenes.begin(), scenes.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return scenes;
}

std::string scene_names() {
  std::string names;
  for (const BuiltinScene& scene : builtin_scenes()) names += (names.empty() ? "" : ", ") + scene.name;
  return names;
}

std::string parameter_list(const BuiltinScene& scene) {
  if (scene.parameters.empty()) return "it has no parameters";
  std::string list;
  for (const BuiltinParameter& p : scene.parameters)
    list += fmt::format("{}{}={} .. {}", list.empty() ? "" : ", ", p.key, p.min, p.max);
  return "its parameters are " + list;
}

double parse_value(const std::string& input, const BuiltinParameter& parameter, std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw InputError(input, fmt::format("the value of {} is not a number: \"{}\"", parameter.key, text),
                     fmt::format("give one from {} to {}", parameter.min, parameter.max));
  if (value < parameter.min || value > parameter.max)
    throw InputError(input, fmt::format("{}={} is out of range", parameter.key, text),
                     fmt::format("give one from {} to {}", parameter.min, parameter.max));
  return value;
}

BuiltinValues parse_query(const std::string& input, const BuiltinScene& scene, std::string_view query) {
  BuiltinValues values;
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
    const size_t equals = pair.find('=');
    const std::string_view key = pair.substr(0, equals);
    const auto parameter =
        std::find_if(scene.parameters.begin(), scene.parameters.end(), [&](const auto& p) { return p.key == key; });
    if (parameter == scene.parameters.end())
      throw InputError(input, fmt::format("{} has no parameter \"{}\"", scene.name, key), parameter_list(scene));
    if (equals == std::string_view::npos)
      throw InputError(input, fmt::format("{} has no value", key), fmt::format("write {}=VALUE", key));
    const double value = parse_value(input, *parameter, pair.substr(equals + 1));
    if (!values.emplace(std::string(key), value).second)
      throw InputError(input, fmt::format("{} is given twice", key), "give it once");
  }
  for (const BuiltinParameter& p : scene.parameters) values.emplace(p.key, p.default_value);
  return values;
}

}  // namespace

std::span<const BuiltinScene> builtin_scenes() {
  static const std::vector<BuiltinScene> scenes = all_scenes();
  return scenes;
}

Scene make_builtin(std::string_view name_and_query) {
  const size_t question = name_and_query.find('?');
  const std::string_view name = name_and_query.substr(0, question);
  const std::string input = "builtin:" + std::string(name_and_query);
  for (const BuiltinScene& scene : builtin_scenes()) {
    if (scene.name != name) continue;
    const bool has_query = question != std::string_view::npos;
    return scene.make(parse_query(input, scene, has_query ? name_and_query.substr(question + 1) : std::string_view()));
  }
  throw InputError(input, fmt::format("there is no built-in scene \"{}\"", name), "choose one of " + scene_names());
}

}  // namespace shadewright
