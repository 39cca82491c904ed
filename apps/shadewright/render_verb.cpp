// shadewright render: one technique, one image.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "options.h"
#include "shadewright/compare/report.h"
#include "shadewright/compare/study.h"
#include "shadewright/error.h"
#include "shadewright/render/image.h"
#include "verbs.h"

namespace shadewright::app {

namespace {

struct Flags {
  SceneFlags scene;
  std::string technique, output, mask, json;
  std::vector<std::string> debug;
};

void check_image_name(const std::string& flag, const std::string& name, bool exr) {
  const std::string ending = std::filesystem::path(name).extension();
  if (name == "-" || ending == ".png" || (exr && ending == ".exr")) return;
  throw InputError(flag + " " + name, exr ? "it ends in neither .png nor .exr" : "it does not end in .png",
                   "name the file so");
}

void list_debug_images(const shadow::Spec& spec, const SceneFlags& flags) {
  const gpu::Device device(device_options(flags));
  for (const std::string& name : shadow::make_technique(device, spec, {16, 16, 1, true})->debug_names())
    fmt::print("{}\n", name);
}

void run(const Flags& flags) {
  const shadow::Spec spec = shadow::parse_spec(flags.technique);
  check_image_name("-o", flags.output, true);
  if (!flags.mask.empty()) check_image_name("--mask", flags.mask, false);
  const bool list_debug = flags.debug == std::vector<std::string>{"list"};
  if (list_debug) return list_debug_images(spec, flags.scene);
  if (!flags.debug.empty() && flags.output == "-")
    throw InputError("-o -", "debug images stand beside the image", "name a file");

  ProgressBar progress(flags.scene.quiet);
  const View view = load_view(flags.scene, progress);
  const gpu::Device device(device_options(flags.scene));
  compare::StudyOptions options{view.width, view.height, flags.scene.repeat, flags.scene.reference_samples, true};
  // Without figures asked for, the truth need not be traced (it is the technique itself for 'ray').
  options.reference = !flags.json.empty() || spec.parameterization == "ray";
  if (!options.reference) options.repeat = 0;
  compare::Study study(device, view.scene, view.camera, view.light, options, progress.callback());
  compare::Outcome outcome = study.run(spec, flags.debug);
  check_validation(device);

  const auto radiance = study.shade(outcome.visibility);
  if (std::filesystem::path(flags.output).extension() == ".exr")
    render::write_exr(radiance, outcome.visibility, view.width, view.height, flags.output);
  else
    write_png(render::to_picture(radiance, view.width, view.height), flags.output);
  if (!flags.mask.empty()) write_png(render::to_picture(outcome.visibility, view.width, view.height), flags.mask);
  for (size_t i = 0; i < outcome.debug.size(); ++i) {
    const std::filesystem::path image(flags.output);
    write_png(outcome.debug[i], image.parent_path() / (image.stem().string() + "-" + flags.debug[i] + ".png"));
  }
  if (!flags.json.empty()) {
    compare::Report report = study.report();
    report.notes = view.notes;
    report.results.push_back(std::move(outcome.result));
    write_text(compare::to_json(report), flags.json);
  }
}

}  // namespace

void add_render(CLI::App& app) {
  auto flags = std::make_shared<Flags>();
  CLI::App* verb = app.add_subcommand("render", "Render a scene with one shadow technique");
  flags->scene.add_to(*verb);
  verb->add_option("-t,--technique", flags->technique, "The technique, as a SPEC (see --help-spec)")->required();
  verb->add_option("-o,--output", flags->output, "IMAGE.png or .exr; - is standard output (PNG)")->required();
  verb->add_option("--mask", flags->mask, "Also write the visibility, MASK.png");
  verb->add_option("--json", flags->json,
                   "Also measure against ray tracing and write the figures; - is standard output");
  verb->add_option("--debug", flags->debug, "Also write a debug image of the technique; 'list' names them");
  verb->add_flag_callback(
      "--help-spec",
      [] {
        fmt::print("{}", shadow::spec_help());
        throw CLI::Success();
      },
      "Print aliases, parts and keys of a SPEC");
  verb->footer("Example: shadewright render builtin:chess -t pcf@2048 -o chess.png");
  verb->callback([flags] { run(*flags); });
}

}  // namespace shadewright::app
