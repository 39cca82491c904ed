// shadewright view: an interactive window.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

#include "debug_images.h"
#include "options.h"
#include "shadewright/error.h"
#include "verbs.h"
#ifdef SHADEWRIGHT_VIEWER
#include "viewer/viewer.h"
#include "viewer/window.h"
#endif

namespace shadewright::app {

namespace {

struct Flags {
  SceneFlags scene;
  std::vector<std::string> techniques{"pcf"};
  bool size_given = false;
};

#ifdef SHADEWRIGHT_VIEWER

/// The window's size: what was asked for, or as much of the standard as the screen has room for.
vk::Extent2D window_size(const Flags& flags, const View& view) {
  if (flags.size_given) return {view.width, view.height};
  const vk::Extent2D room = viewer::Desktop::largest_window();
  return {std::min(view.width, room.width), std::min(view.height, room.height)};
}

void show(const Flags& flags, std::span<const shadow::Spec> specs) {
  const viewer::Desktop desktop;
  ProgressBar progress(flags.scene.quiet);
  const View view = load_view(flags.scene, progress, progress.callback());
  check_specs(specs, view);
  gpu::DeviceOptions options = device_options(flags.scene);
  options.instance_extensions = viewer::Desktop::instance_extensions();
  options.device_extensions = viewer::Desktop::device_extensions();
  const gpu::Device device(options);
  check_debug(device, specs.first(1), flags.scene.debug);
  {
    viewer::Window window(desktop, device, view.scene.name + " - Shadewright", window_size(flags, view));
    viewer::run(window, device, view.scene,
                {flags.scene.scene,
                 view.camera,
                 view.light,
                 flags.scene.fov ? std::optional(glm::radians(*flags.scene.fov)) : std::nullopt,
                 view.path,
                 {specs.begin(), specs.end()},
                 flags.scene.debug.empty() ? "" : flags.scene.debug.front()});
  }
  check_validation(device);
}

#else

void show(const Flags&, std::span<const shadow::Spec>) {
  throw FailureError("view", "this program was built without its window", "build it with -DSHADEWRIGHT_VIEWER=ON");
}

#endif

void run(const Flags& flags) {
  std::vector<shadow::Spec> specs;
  for (const std::string& text : flags.techniques) specs.push_back(shadow::parse_spec(text));
  if (specs.size() > 2)
    throw InputError("-t " + flags.techniques[2], "a window shows two techniques side by side", "give at most two");
  show(flags, specs);
}

}  // namespace

void add_view(CLI::App& app) {
  auto flags = std::make_shared<Flags>();
  CLI::App* verb = app.add_subcommand("view", "Walk through a scene in a window and try techniques out");
  flags->scene.add_view_to(*verb);
  verb->get_option("--size")->description("The window's size WxH; unless given, what the screen has room for");
  verb->add_option("--path", flags->scene.path, "Begin along a camera path of the scene, by name");
  verb->add_option(
          "-t,--technique", flags->techniques,
          "A technique, as a SPEC (see shadewright render --help-spec); a second one stands beside it, and 'ray' "
          "is the truth")
      ->capture_default_str()
      ->take_all()
      ->allow_extra_args(false);
  verb->add_option("--debug", flags->scene.debug, "Begin with a debug image of the technique, by name")->expected(1);
  verb->footer(
      "Example: shadewright view builtin:city --camera street -t psm@1024 -t ray\n"
      "Drag looks around, right drag circles, W A S D Q E walk, Escape closes; the window tells the rest.");
  verb->callback([flags, verb] {
    flags->size_given = verb->get_option("--size")->count() > 0;
    run(*flags);
  });
}

}  // namespace shadewright::app
