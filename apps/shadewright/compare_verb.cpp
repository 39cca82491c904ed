// shadewright compare: techniques side by side against ray tracing.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <span>

#include "debug_images.h"
#include "interrupt.h"
#include "options.h"
#include "shadewright/compare/approximation.h"
#include "shadewright/compare/path_study.h"
#include "shadewright/error.h"
#include "shadewright/shadow/technique.h"
#include "verbs.h"

namespace shadewright::app {

namespace {

struct Flags {
  SceneFlags scene;
  std::vector<std::string> techniques;
  std::string output, against;
  bool against_triangles = false;
  bool every_frame = false;
};

/// What is compared when nothing is asked for: everything there is, at its default, that serves the light.
const std::vector<std::string> default_techniques = {"sm",  "sm@4096", "pcf",  "vsm",  "csm",  "psm",
                                                     "rtw", "rmsm",    "spsm", "rgsm", "cpvs", "ray"};

compare::Report read_report(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError("--against " + file, "can't be read", "name a report.json that compare wrote");
  return compare::from_json({std::istreambuf_iterator<char>(stream), {}}, file);
}

std::string truncated(const std::string& text, size_t width) {
  return text.size() <= width ? text : text.substr(0, width - 1) + "~";
}

void print_table(const compare::Report& report) {
  fmt::print("{}, {}x{}, {} ({:.1f} % lit in truth, camera pass {:.1f} ms, one shadow ray a pixel {:.1f} ms)\n",
             report.scene_name, report.width, report.height, report.device_name, 100 * report.reference_lit_fraction,
             report.camera_pass_milliseconds, report.reference_milliseconds);
  const bool moving = report.path.has_value();
  if (moving)
    fmt::print("{} frames{}{}, figures over all of them\n", report.path->frames,
               report.path->name.empty() ? "" : " along ", report.path->name);
  fmt::print("{:<34} {:>8} {:>9} {:>9} {:>8} {:>9} {:>9} {:>8}{}\n", "technique", "wrong %", "edge %", "f.shadow",
             "f.lit", "ms", "frame ms", "MB", moving ? " flicker %" : "");
  for (const auto& result : report.results) {
    fmt::print("{:<34} {:>8.3f} {:>9.2f} {:>9} {:>8} {:>9.1f} {:>9.1f} {:>8.1f}", truncated(result.technique, 34),
               100 * result.error.fraction, 100 * result.error.boundary_fraction, result.error.false_shadow,
               result.error.false_lit, result.milliseconds.median, result.frame_milliseconds,
               static_cast<double>(result.memory_bytes()) / 1e6);
    if (result.error.flicker) fmt::print(" {:>9.4f}", 100 * *result.error.flicker);
    fmt::print("\n");
  }
}

/// One sentence on how the truth of the points in `study` differs from that of the triangles they stand for.
std::string cost_of_points(const SceneFlags& flags, const gpu::Device& device, const compare::Study& study,
                           ProgressBar& bar, const Progress& progress) {
  SceneFlags as_triangles = flags;
  as_triangles.points = "off";
  as_triangles.quiet = true;
  const View view = load_view(as_triangles, bar, progress);
  const compare::Study exact(device, view.scene, view.camera, view.light, {view.width, view.height, 0, 0, true},
                             progress);
  const std::vector<float> shown(study.reference().begin(), study.reference().end());
  const auto error = compare::approximation_error(exact.points(), exact.reference(), study.points(), shown, view.light);
  return fmt::format(
      "Against triangles, the points' truth has another shadow in {:.3f} % of {} pixels, {:.2f} % instead of {:.2f} % "
      "are lit, and {} pixels show sky for surface or surface for sky.",
      100 * error.fraction, error.compared, 100 * error.lit_shown, 100 * error.lit_exact, error.coverage);
}

compare::Report compare_view(const Flags& flags, const View& view, const gpu::Device& device,
                             std::span<const shadow::Spec> specs, const compare::Report* before, ProgressBar& bar,
                             const Progress& progress) {
  const compare::StudyOptions options{view.width, view.height, flags.scene.repeat, flags.scene.reference_samples, true};
  if (!view.moments.empty()) {
    if (flags.against_triangles)
      throw InputError("--against-triangles", "it compares a single view, not the frames of a path",
                       "leave --path, --frames and --sun-to out");
    compare::PathStudy study(device, view.scene, view.path, view.moments, options);
    study.add_notes(view.notes);
    return compare::compare_along_path(study, specs, flags.output, flags.every_frame, before, progress,
                                       flags.scene.debug);
  }
  if (flags.every_frame)
    throw InputError("--every-frame", "there is only one frame", "give --path, --frames or --sun-to as well");
  compare::Study study(device, view.scene, view.camera, view.light, options, progress);
  study.add_notes(view.notes);
  if (flags.against_triangles) {
    const std::string cost = cost_of_points(flags.scene, device, study, bar, progress);
    study.add_notes(std::span(&cost, 1));
  }
  return compare::compare_techniques(study, specs, flags.output, before, progress, flags.scene.debug);
}

void run(const Flags& flags) {
  if (flags.against_triangles && flags.scene.points == "off")
    throw InputError("--against-triangles", "the scene is drawn as triangles already", "give --points auto too");
  std::vector<shadow::Spec> specs;
  for (const std::string& text : flags.techniques.empty() ? default_techniques : flags.techniques)
    for (const std::string& one : shadow::expand_sweep(text)) specs.push_back(shadow::parse_spec(one));
  std::optional<compare::Report> before;
  if (!flags.against.empty()) before = read_report(flags.against);

  if (asks_for_list(flags.scene.debug)) {
    const gpu::Device device(device_options(flags.scene));
    for (const shadow::Spec& spec : specs)
      fmt::print("{}: {}\n", spec.text, fmt::join(debug_names(device, spec), ", "));
    return;
  }
  if (std::filesystem::exists(flags.output) && !std::filesystem::is_directory(flags.output))
    throw InputError("-o " + flags.output, "it is a file, the report needs a folder", "name another one");

  ProgressBar bar(flags.scene.quiet);
  const Progress progress = interruptible(bar.callback());
  const View view = load_view(flags.scene, bar, progress);
  if (flags.techniques.empty())
    std::erase_if(specs, [&](const shadow::Spec& spec) { return !shadow::serves(spec, view.light.kind); });
  check_specs(specs, view);
  const gpu::Device device(device_options(flags.scene));
  check_debug(device, specs, flags.scene.debug);
  const compare::Report report = compare_view(flags, view, device, specs, before ? &*before : nullptr, bar, progress);
  bar.clear();
  check_validation(device);
  if (flags.scene.quiet) return;
  print_later_notes(report.notes, view);
  print_table(report);
  if (before) fmt::print("\nagainst {}\n{}", flags.against, compare::describe_changes(*before, report));
  fmt::print("report: {}\n", (std::filesystem::path(flags.output) / "index.html").string());
}

}  // namespace

void add_compare(CLI::App& app) {
  auto flags = std::make_shared<Flags>();
  CLI::App* verb = app.add_subcommand("compare", "Hold techniques against ray tracing: error, time, memory, pictures");
  flags->scene.add_to(*verb);
  verb->add_option("-t,--technique", flags->techniques,
                   "A technique as a SPEC, or a sweep like sm@512..4096; repeatable")
      ->take_all()
      ->allow_extra_args(false);
  verb->add_option("-o,--output", flags->output, "Folder for index.html, report.json, report.csv and pictures")
      ->required();
  verb->add_option("--against", flags->against, "An earlier report.json: tell what changed");
  verb->add_flag("--against-triangles", flags->against_triangles,
                 "With --points: also tell how the points' truth differs from the triangles'");
  verb->add_flag("--every-frame", flags->every_frame,
                 "Along a path, also write the picture of each frame: DIR/TECHNIQUE-frames/0000.png and so on");
  verb->footer(
      "Example: shadewright compare builtin:sandbox -t sm@512..4096 -t pcf@2048 -o out/sandbox\n"
      "A path: shadewright compare builtin:street --path main --frames 60 -t sm@1024 -t pcf@1024 -o out/street");
  verb->callback([flags] { run(*flags); });
}

}  // namespace shadewright::app
