// shadewright scenes: the built-in scenes, listed or written out.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <array>
#include <memory>

#include "options.h"
#include "shadewright/error.h"
#include "shadewright/scene/builtin.h"
#include "shadewright/scene/load.h"
#include "verbs.h"

namespace shadewright::app {

namespace {

void list() {
  for (const BuiltinScene& scene : builtin_scenes()) {
    fmt::print("{:<12} {}\n", scene.name, scene.help);
    for (const BuiltinParameter& p : scene.parameters)
      fmt::print("{:<12}   ?{}={:g}  {} ({:g} to {:g})\n", "", p.key, p.default_value, p.help, p.min, p.max);
  }
}

template <typename Named>
std::string names(const std::vector<Named>& things) {
  std::string result;
  for (const Named& thing : things) result += (result.empty() ? "" : ", ") + thing.name;
  return result.empty() ? "none" : result;
}

void run(const std::string& name, const std::string& output) {
  if (name.empty() && !output.empty())
    throw InputError("-o " + output, "no scene is named", "write shadewright scenes NAME -o " + output);
  if (name.empty()) return list();
  check_outputs(std::array<Output, 1>{{{"-o", output}}});
  const Scene scene = make_builtin(name);
  if (!output.empty()) return write_glb(scene, output);
  fmt::print("{}: {} triangles in {} instances of {} meshes\ncameras: {}\nlights: {}\npaths: {}\n", scene.name,
             triangle_count(scene), scene.instances.size(), scene.meshes.size(), names(scene.cameras),
             names(scene.lights), names(scene.paths));
}

}  // namespace

void add_scenes(CLI::App& app) {
  auto name = std::make_shared<std::string>(), output = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("scenes", "List the built-in scenes, describe one, or write one out");
  verb->add_option("NAME", *name, "A built-in scene, NAME[?key=value&...]");
  verb->add_option("-o,--output", *output, "Write it as FILE.glb");
  verb->footer("Example: shadewright scenes sandbox -o sandbox.glb");
  verb->callback([name, output] { run(*name, *output); });
}

}  // namespace shadewright::app
