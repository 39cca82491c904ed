// shadewright info: what a .cpvs file holds.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "options.h"
#include "shadewright/voxel/file.h"
#include "shadewright/voxel/info.h"
#include "verbs.h"

namespace shadewright::app {

namespace {

void run(const std::string& file, const std::string& json) {
  check_outputs(std::array<Output, 1>{{{"--json", json}}});
  const voxel::VoxelShadow shadow = voxel::open(file);
  const voxel::ShadowProperties& p = shadow.properties();
  const std::string kind = p.light.kind == LightKind::spot ? "spot" : "directional";
  const double map_bytes = 2.0 * p.light.size() * p.light.size();
  if (!json.empty()) {
    nlohmann::ordered_json dags = nlohmann::ordered_json::array();
    for (size_t i = 0; i < shadow.dags().size(); ++i) {
      nlohmann::ordered_json levels = nlohmann::ordered_json::array();
      for (const auto& level : voxel::count_levels(shadow, i))
        levels.push_back(
            {{"height", level.height}, {"unmerged", level.unmerged}, {"merged", level.merged}, {"bytes", level.bytes}});
      dags.push_back({{"resolution", 1u << shadow.dags()[i].log2_size}, {"levels", levels}});
    }
    const nlohmann::ordered_json text = {{"schema", "shadewright.info/1"},
                                         {"file", file},
                                         {"light", kind},
                                         {"resolution", p.light.size()},
                                         {"depth", p.light.depth()},
                                         {"texel_metres", {p.light.texel_size.x, p.light.texel_size.y}},
                                         {"max_filter", p.max_filter},
                                         {"static_receivers", p.static_receivers},
                                         {"all_closed", p.all_closed},
                                         {"dag_bytes", shadow.dag_bytes()},
                                         {"grid_bytes", shadow.grid_bytes()},
                                         {"dags", dags}};
    return write_text(text.dump(2) + "\n", json);
  }
  fmt::print("{}: {} light, {}x{}x{} voxels of {:.4g} x {:.4g} m{}\n", file, kind, p.light.size(), p.light.size(),
             p.light.depth(), p.light.texel_size.x, p.light.texel_size.y,
             p.light.kind == LightKind::spot ? " at 1 m" : "");
  fmt::print("filters up to {}x{}; {}; {}\n", p.max_filter, p.max_filter,
             p.static_receivers ? "for the static scene's own surfaces only" : "for any receiver",
             shadow.dags().size() > 1
                 ? fmt::format("{} lower resolutions for distant receivers", shadow.dags().size() - 1)
                 : "no lower resolutions");
  fmt::print("{:.2f} MB ({:.4f} % of a 16-bit map) and a grid of {:.2f} MB\n",
             static_cast<double>(shadow.dag_bytes()) / 1e6, 100.0 * static_cast<double>(shadow.dag_bytes()) / map_bytes,
             static_cast<double>(shadow.grid_bytes()) / 1e6);
  fmt::print("{:>10} {:>14} {:>12} {:>12}\n", "node side", "in the tree", "merged", "bytes");
  for (const auto& level : voxel::count_levels(shadow))
    fmt::print("{:>10} {:>14.0f} {:>12} {:>12}\n", level.height == 0 ? "leaf" : std::to_string(1u << level.height),
               level.unmerged, level.merged, level.bytes);
}

}  // namespace

void add_info(CLI::App& app) {
  auto file = std::make_shared<std::string>(), json = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("info", "Tell what a .cpvs file holds");
  verb->add_option("FILE", *file, "FILE.cpvs")->required();
  verb->add_option("--json", *json, "Write it as JSON; - is standard output");
  verb->footer(
      "Example: shadewright bake builtin:landscape -r 4096 -o sun.cpvs\n"
      "         shadewright info sun.cpvs");
  verb->callback([file, json] { run(*file, *json); });
}

}  // namespace shadewright::app
