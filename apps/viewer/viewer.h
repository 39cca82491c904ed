// The window's life: what a person does becomes a view, techniques and a light, and these a picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "shadewright/gpu/device.h"
#include "shadewright/scene/scene.h"
#include "shadewright/shadow/spec.h"
#include "window.h"

namespace shadewright::viewer {

/// What the window shows at first.
struct Start {
  std::string scene_source;  ///< as it is named on the command line
  Camera camera;
  Light light;
  std::optional<double> fov_y;      ///< radians, along paths too; none: as these say
  std::string path;                 ///< a camera path to follow; empty: none
  std::vector<shadow::Spec> specs;  ///< of the left side, and of the right one
  std::string debug;                ///< a debug image to show; empty: none
};

/// Shows `scene` until the person closes the window.
void run(Window& window, const gpu::Device& device, const Scene& scene, const Start& start);

}  // namespace shadewright::viewer
