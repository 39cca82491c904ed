// The flags that verbs share (architecture, section 5): which scene, seen and lit how, on which device.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "progress_bar.h"
#include "shadewright/gpu/device.h"
#include "shadewright/scene/load.h"
#include "shadewright/scene/moments.h"
#include "shadewright/scene/scene.h"
#include "shadewright/shadow/technique.h"

namespace CLI {
class App;
}

namespace shadewright::app {

struct LightFlags {
  std::string light, sun;

  void add_to(CLI::App& verb);
};

struct SceneFlags {
  std::string scene;
  std::string camera, eye, target;
  std::optional<double> fov;  ///< degrees
  LightFlags light;
  std::string size = "1920x1080";
  uint32_t repeat = 10;
  uint32_t reference_samples = 16;
  std::string path, sun_to;
  uint32_t frames = 0;  ///< 0 = not given
  std::string points = "off";
  std::vector<std::string> debug;
  std::string device;
  bool quiet = false, verbose = false, validation = false;

  /// All of them.
  void add_to(CLI::App& verb);
  /// Which scene, camera and light, how large, on which device: without what frames, repeats and truths are about.
  void add_view_to(CLI::App& verb);
};

/// The scene with the camera and light that the flags, the file, or our own judgement chose.
struct View {
  Scene scene;
  Camera camera;
  Light light;
  uint32_t width = 0, height = 0;
  std::string path;                ///< name of the camera path; empty without one
  std::vector<Moment> moments;     ///< the frames, if more than the one view was asked for; `camera` is the first one's
  std::vector<std::string> notes;  ///< what was chosen or warned of
};

/// Loads and chooses; prints warnings and choices to stderr unless quiet. InputError for what does not fit. `progress`
/// shows itself on `bar`.
View load_view(const SceneFlags& flags, ProgressBar& bar, const Progress& progress);
/// Prints to stderr what a report notes beyond the view's own notes.
void print_later_notes(std::span<const std::string> notes, const View& view);
/// InputError where a technique can't serve the view's light, in any of its frames (see shadow::check).
void check_specs(std::span<const shadow::Spec> specs, const View& view);

/// The light that the flags, the scene, or our own judgement chose; what was chosen is added to `notes`.
Light choose_light(const LightFlags& flags, const Scene& scene, std::vector<std::string>& notes);
/// "WxH" in pixels; InputError naming --size.
void parse_size(const std::string& text, uint32_t& width, uint32_t& height);
/// InputError where `value` is not from `min` to `max`.
void check_range(const std::string& flag, double value, double min, double max);
/// "X0,Y0,Z0,X1,Y1,Z1"; InputError naming `flag`.
Box parse_bounds(const std::string& flag, const std::string& text);
/// A flag that names a file to be written, and what was given; empty if nothing was.
struct Output {
  std::string flag, file;
};
/// Before any work: InputError where a file can't be written because its folder does not exist, or where two are one.
void check_outputs(std::span<const Output> outputs);
/// Writes `text` to `file`; "-" is standard output.
void write_text(const std::string& text, const std::string& file);

gpu::DeviceOptions device_options(const SceneFlags& flags);
/// After the work: FailureError if the validation layer had something to say.
void check_validation(const gpu::Device& device);

}  // namespace shadewright::app
