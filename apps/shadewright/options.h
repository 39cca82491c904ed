// The flags that verbs share (architecture, section 5): which scene, seen and lit how, on which device.
#pragma once

#include <cstdint>
#include <string>

#include "progress_bar.h"
#include "shadewright/gpu/device.h"
#include "shadewright/scene/load.h"
#include "shadewright/scene/moments.h"
#include "shadewright/scene/scene.h"

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
  double fov = 0;
  LightFlags light;
  std::string size = "1920x1080";
  uint32_t repeat = 10;
  uint32_t reference_samples = 16;
  std::string path, sun_to;
  uint32_t frames = 0;  ///< 0 = not given
  std::string points = "off";
  std::string device;
  bool quiet = false, verbose = false, validation = false;

  void add_to(CLI::App& verb);
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

/// Loads and chooses; prints warnings and choices to stderr unless quiet. InputError for what does not fit.
View load_view(const SceneFlags& flags, ProgressBar& progress);

/// The light that the flags, the scene, or our own judgement chose; what was chosen is added to `notes`.
Light choose_light(const LightFlags& flags, const Scene& scene, std::vector<std::string>& notes);
/// "WxH" in pixels; InputError naming --size.
void parse_size(const std::string& text, uint32_t& width, uint32_t& height);
/// "X0,Y0,Z0,X1,Y1,Z1"; InputError naming `flag`.
Box parse_bounds(const std::string& flag, const std::string& text);
/// Writes `text` to `file`; "-" is standard output.
void write_text(const std::string& text, const std::string& file);

gpu::DeviceOptions device_options(const SceneFlags& flags);
/// After the work: FailureError if the validation layer had something to say.
void check_validation(const gpu::Device& device);

}  // namespace shadewright::app
