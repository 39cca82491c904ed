// shadewright bake: the shadow of a light that never moves, as a .cpvs file (CPVS 2014).
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "interrupt.h"
#include "options.h"
#include "shadewright/error.h"
#include "shadewright/files.h"
#include "shadewright/voxel/bake.h"
#include "shadewright/voxel/file.h"
#include "verbs.h"

namespace shadewright::app {

namespace {

struct Flags {
  LightFlags light;
  std::string scene, output, json, bounds, closed = "auto", resolving = "stabbed";
  uint32_t depth_bits = 0;
  bool quiet = false, verbose = false, compress = false;
  voxel::BakeOptions options;
};

nlohmann::ordered_json to_json(const voxel::BakeResult& result, const std::string& file) {
  const voxel::BakeStatistics& s = result.statistics;
  nlohmann::ordered_json levels = nlohmann::ordered_json::array(), stages = nlohmann::ordered_json::array();
  for (const auto& level : s.levels)
    levels.push_back(
        {{"height", level.height}, {"unmerged", level.unmerged}, {"merged", level.merged}, {"bytes", level.bytes}});
  for (const auto& stage : s.stages) stages.push_back({{"name", stage.name}, {"seconds", stage.seconds}});
  std::error_code ignored;
  return {{"schema", "shadewright.bake/1"},
          {"file", file},
          {"file_bytes", std::filesystem::file_size(file, ignored)},
          {"resolution", result.shadow.light().size()},
          {"depth", result.shadow.light().depth()},
          {"triangles", s.triangles},
          {"moving_instances", s.moving_instances},
          {"silhouette_triangles", s.silhouette_triangles},
          {"components",
           {{"closed", s.components.closed},
            {"open", s.components.open},
            {"inwards", s.components.inwards},
            {"inhabited", s.components.inhabited}}},
          {"dag_bytes", result.shadow.dag_bytes()},
          {"grid_bytes", result.shadow.grid_bytes()},
          {"levels", levels},
          {"stages", stages},
          {"seconds", s.seconds},
          {"peak_bytes", s.peak_bytes}};
}

void run(Flags flags) {
  if (flags.output == "-") throw InputError("-o -", "a baked shadow is a file to be mapped", "name a file");
  check_outputs(std::array<Output, 2>{{{"-o", flags.output}, {"--json", flags.json}}});
  check_range("--memory", flags.options.memory_gigabytes, 0.05, 4096);
  flags.options.closed = flags.closed == "all"    ? voxel::ClosedMode::all
                         : flags.closed == "none" ? voxel::ClosedMode::none
                                                  : voxel::ClosedMode::automatic;
  flags.options.resolving = flags.resolving == "paper" ? voxel::Resolving::paper : voxel::Resolving::stabbed;
  if (flags.depth_bits != 0) flags.options.depth_voxels = 1u << flags.depth_bits;
  if (!flags.bounds.empty()) flags.options.bounds = parse_bounds("--bounds", flags.bounds);

  ProgressBar bar(flags.quiet);
  const Progress progress = interruptible(bar.callback());
  LoadedScene loaded = load_scene(flags.scene, progress);
  std::vector<std::string> notes = loaded.warnings;
  const Light light = choose_light(flags.light, loaded.scene, notes);
  if (flags.options.bounds) {
    flags.options.bounds->min -= loaded.scene.origin;
    flags.options.bounds->max -= loaded.scene.origin;
  }
  const voxel::BakeResult result = voxel::bake(loaded.scene, light, flags.options, progress);
  // Points are asked for in the file's coordinates, whatever the scene was moved by.
  voxel::save(result.shadow.moved(loaded.scene.origin), flags.output, {flags.compress}, progress);
  if (!flags.json.empty()) write_text(to_json(result, flags.output).dump(2) + "\n", flags.json);
  if (flags.quiet) return;

  bar.clear();
  for (const std::string& note : notes) fmt::print(stderr, "{}\n", note);
  for (const std::string& note : result.statistics.components.notes) fmt::print(stderr, "{}\n", note);
  if (flags.verbose)
    for (const voxel::StageSeconds& stage : result.statistics.stages)
      fmt::print(stderr, "{:>8.2f} s  {}\n", stage.seconds, stage.name);
  const double map_bytes = 2.0 * result.shadow.light().size() * result.shadow.light().size();
  fmt::print(stderr,
             "{}: {} triangles at {}x{}x{}, {:.1f} s, {:.1f} MB and a grid of {:.1f} MB ({:.4f} % of a 16-bit map), "
             "peak {:.0f} MB\n",
             flags.output, result.statistics.triangles, result.shadow.light().size(), result.shadow.light().size(),
             result.shadow.light().depth(), result.statistics.seconds,
             static_cast<double>(result.shadow.dag_bytes()) / 1e6,
             static_cast<double>(result.shadow.grid_bytes()) / 1e6,
             100.0 * static_cast<double>(result.shadow.dag_bytes()) / map_bytes,
             static_cast<double>(result.statistics.peak_bytes) / 1e6);
}

}  // namespace

void add_bake(CLI::App& app) {
  auto flags = std::make_shared<Flags>();
  CLI::App* verb = app.add_subcommand("bake", "Bake the shadow of a light that never moves into a .cpvs file");
  verb->add_option("SCENE", flags->scene, "A file or builtin:NAME; instances with a motion are left out")->required();
  flags->light.add_to(*verb);
  verb->add_option("-r,--resolution", flags->options.resolution, "Voxels per axis, a power of two from 64 to 1048576")
      ->required();
  verb->add_option("-o,--output", flags->output, "FILE.cpvs")->required();
  verb->add_option("--closed", flags->closed, "Whose inside may be left undefined: bodies found closed, all, none")
      ->check(CLI::IsMember({"auto", "all", "none"}))
      ->capture_default_str();
  verb->add_flag("--static", flags->options.static_receivers, "Only the static scene itself will receive: smaller");
  verb->add_option("--max-filter", flags->options.max_filter, "Largest filter that look-ups will use, odd, up to 17")
      ->capture_default_str();
  verb->add_flag("--mraa", flags->options.pyramid, "Also bake every lower resolution, for distant receivers");
  verb->add_option("--bounds", flags->bounds,
                   "Only this box needs shadows: X0,Y0,Z0,X1,Y1,Z1 in the file's coordinates");
  verb->add_option("--memory", flags->options.memory_gigabytes, "Give up rather than hold more, GB")
      ->capture_default_str();
  verb->add_option("--threads", flags->options.threads, "0 = all cores")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  verb->add_option("--depth-bits", flags->depth_bits, "log2 of the voxels along the light, if fewer than across")
      ->check(CLI::Range(6, 20));
  verb->add_option("--resolving", flags->resolving,
                   "How undefined voxels get a value: the paper's rule, or stabbed (smaller)")
      ->check(CLI::IsMember({"paper", "stabbed"}))
      ->capture_default_str();
  verb->add_flag("--compress", flags->compress,
                 "Compress the file (zstd): smaller on disk, but read into memory instead of mapped");
  verb->add_option("--json", flags->json, "Also write statistics; - is standard output");
  verb->add_flag("--quiet", flags->quiet, "No progress, no remarks");
  verb->add_flag("--verbose", flags->verbose, "Also tell how long each stage took");
  verb->footer("Example: shadewright bake builtin:landscape -r 65536 -o sun.cpvs");
  verb->callback([flags] { run(*flags); });
}

}  // namespace shadewright::app
