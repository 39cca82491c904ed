#include "scene/file_options.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "shadewright/error.h"

namespace shadewright {
namespace {

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (size_t begin = 0;;) {
    const size_t end = text.find(separator, begin);
    parts.emplace_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

bool matches(const std::string& pattern, const std::string& name) {
  if (pattern.ends_with('*')) return name.starts_with(std::string_view(pattern).substr(0, pattern.size() - 1));
  return name == pattern;
}

void leave_out(const FileOptions& options, SceneGraph& graph) {
  std::vector<bool> used(options.without.size(), false);
  for (GraphNode& node : graph.nodes)
    for (size_t p = 0; p < options.without.size(); ++p) {
      if (!matches(options.without[p], node.name)) continue;
      used[p] = true;
      node.parts.clear();
    }
  for (size_t p = 0; p < used.size(); ++p)
    if (!used[p])
      throw InputError(options.path + "?without=" + options.without[p], "no node has that name",
                       "name a node of the file");
}

/// Puts everything under one more root that turns +Z to +Y.
void turn_up(SceneGraph& graph) {
  for (GraphNode& node : graph.nodes) node.parent = node.parent ? *node.parent + 1 : 0;
  GraphNode root;
  root.name = "up";
  root.parent_from_node = glm::dmat4(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1);
  graph.nodes.insert(graph.nodes.begin(), std::move(root));
}

}  // namespace

FileOptions parse_file_options(const std::string& source) {
  const size_t question = source.rfind('?');
  std::error_code error;
  if (question == std::string::npos || std::filesystem::exists(source, error)) return {source, false, {}};
  FileOptions options{source.substr(0, question), false, {}};
  for (const std::string& item : split(std::string_view(source).substr(question + 1), '&')) {
    const size_t equals = item.find('=');
    const std::string key = item.substr(0, equals), value = equals == std::string::npos ? "" : item.substr(equals + 1);
    if (key == "up" && (value == "y" || value == "z"))
      options.z_up = value == "z";
    else if (key == "without" && !value.empty())
      options.without = split(value, ',');
    else
      throw InputError(source, "'" + item + "' is not an option of a file",
                       "options are up=y, up=z and without=NAME,NAME*");
  }
  return options;
}

void apply(const FileOptions& options, SceneGraph& graph) {
  if (!options.without.empty()) leave_out(options, graph);
  if (options.z_up) turn_up(graph);
}

}  // namespace shadewright
