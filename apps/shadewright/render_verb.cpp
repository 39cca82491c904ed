// shadewright render: one technique, one image.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "debug_images.h"
#include "options.h"
#include "shadewright/compare/path_study.h"
#include "shadewright/compare/report.h"
#include "shadewright/error.h"
#include "shadewright/render/image.h"
#include "verbs.h"

namespace shadewright::app {

namespace {

struct Flags {
  SceneFlags scene;
  std::string technique, output, mask, json;
};

void check_image_name(const std::string& flag, const std::string& name, bool exr) {
  const std::string ending = std::filesystem::path(name).extension();
  if (name == "-" || ending == ".png" || (exr && ending == ".exr")) return;
  throw InputError(flag + " " + name, exr ? "it ends in neither .png nor .exr" : "it does not end in .png",
                   "name the file so");
}

/// "image.png" to "image-NAME.png".
std::string debug_file(const std::string& output, const std::string& name) {
  const std::filesystem::path image(output);
  return (image.parent_path() / (image.stem().string() + "-" + name + ".png")).string();
}

void check_all_outputs(const Flags& flags) {
  check_image_name("-o", flags.output, true);
  if (!flags.mask.empty()) check_image_name("--mask", flags.mask, false);
  if (!flags.scene.debug.empty() && flags.output == "-")
    throw InputError("-o -", "debug images stand beside the image", "name a file");
  std::vector<Output> outputs{{"-o", flags.output}, {"--mask", flags.mask}, {"--json", flags.json}};
  for (const std::string& name : flags.scene.debug) outputs.push_back({"--debug", debug_file(flags.output, name)});
  check_outputs(outputs);
}

/// "image.png" to "image_0007.png".
std::string numbered(const std::string& file, uint32_t frame) {
  const std::filesystem::path path(file);
  return (path.parent_path() / fmt::format("{}_{:04}{}", path.stem().string(), frame, path.extension().string()))
      .string();
}

/// Writes what a technique showed: `radiance` is the scene lit with its visibility.
void write_images(const Flags& flags, const View& view, const compare::Outcome& outcome,
                  std::span<const glm::vec3> radiance, const std::string& output, const std::string& mask) {
  if (std::filesystem::path(output).extension() == ".exr")
    render::write_exr(radiance, outcome.visibility, view.width, view.height, output);
  else
    write_png(render::to_picture(radiance, view.width, view.height), output);
  if (!mask.empty()) write_png(render::to_picture(outcome.visibility, view.width, view.height), mask);
  for (size_t i = 0; i < outcome.debug.size(); ++i)
    write_png(outcome.debug[i], debug_file(output, flags.scene.debug[i]));
}

/// Writes and says what was measured, if anything was to be.
void write_report(const Flags& flags, const View& view, const compare::Report& report) {
  if (flags.json.empty()) return;
  write_text(compare::to_json(report), flags.json);
  if (!flags.scene.quiet) print_later_notes(report.notes, view);
}

void render_view(const Flags& flags, const shadow::Spec& spec, const View& view, const gpu::Device& device,
                 const compare::StudyOptions& options, ProgressBar& progress) {
  compare::Study study(device, view.scene, view.camera, view.light, options, progress.callback());
  study.add_notes(view.notes);
  compare::Outcome outcome = study.run(spec, flags.scene.debug);
  check_validation(device);
  write_images(flags, view, outcome, study.shade(outcome.visibility), flags.output, flags.mask);
  compare::Report report = study.report();
  report.results.push_back(std::move(outcome.result));
  progress.clear();
  write_report(flags, view, report);
}

void render_frames(const Flags& flags, const shadow::Spec& spec, const View& view, const gpu::Device& device,
                   const compare::StudyOptions& options, ProgressBar& progress) {
  if (flags.output == "-" || flags.mask == "-")
    throw InputError("-o -", "several frames are several images", "name a file, they are numbered after it");
  compare::PathStudy study(device, view.scene, view.path, view.moments, options);
  study.add_notes(view.notes);
  const auto write = [&](uint32_t frame, std::span<const compare::Outcome> outcomes) {
    const compare::Outcome& outcome = outcomes.front();
    write_images(flags, view, outcome, study.shade(outcome.visibility), numbered(flags.output, frame),
                 flags.mask.empty() ? "" : numbered(flags.mask, frame));
  };
  const compare::Report report = study.run(std::span(&spec, 1), flags.scene.debug, write, progress.callback());
  progress.clear();
  write_report(flags, view, report);
}

void run(const Flags& flags) {
  const shadow::Spec spec = shadow::parse_spec(flags.technique);
  if (asks_for_list(flags.scene.debug)) {
    for (const std::string& name : debug_names(gpu::Device(device_options(flags.scene)), spec))
      fmt::print("{}\n", name);
    return;
  }
  check_all_outputs(flags);

  ProgressBar progress(flags.scene.quiet);
  const View view = load_view(flags.scene, progress, progress.callback());
  check_specs(std::span(&spec, 1), view);
  const gpu::Device device(device_options(flags.scene));
  check_debug(device, std::span(&spec, 1), flags.scene.debug);
  compare::StudyOptions options{view.width, view.height, flags.scene.repeat, flags.scene.reference_samples, true};
  // Without figures asked for, the truth need not be traced (it is the technique itself for 'ray').
  options.reference = !flags.json.empty() || spec.parameterization == "ray";
  if (!options.reference) options.repeat = 0;
  if (view.moments.empty())
    render_view(flags, spec, view, device, options, progress);
  else
    render_frames(flags, spec, view, device, options, progress);
  check_validation(device);
}

}  // namespace

void add_render(CLI::App& app) {
  auto flags = std::make_shared<Flags>();
  CLI::App* verb = app.add_subcommand("render", "Render a scene with one shadow technique");
  flags->scene.add_to(*verb);
  verb->add_option("-t,--technique", flags->technique, "The technique, as a SPEC (see --help-spec)")->required();
  verb->add_option("-o,--output", flags->output,
                   "IMAGE.png or .exr; - is standard output (PNG). Frames of a path are numbered: IMAGE_0000.png")
      ->required();
  verb->add_option("--mask", flags->mask, "Also write the visibility, MASK.png");
  verb->add_option("--json", flags->json,
                   "Also measure against ray tracing and write the figures; - is standard output");
  verb->add_flag_callback(
      "--help-spec",
      [] {
        fmt::print("{}", shadow::spec_help());
        throw CLI::Success();
      },
      "Print aliases, parts and keys of a SPEC");
  verb->footer(
      "Example: shadewright render builtin:chess -t pcf@2048 -o chess.png\n"
      "A path: shadewright render builtin:street --path main --frames 60 -t pcf@2048 -o street.png");
  verb->callback([flags] { run(*flags); });
}

}  // namespace shadewright::app
