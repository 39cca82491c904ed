// Bakes precomputed shadows on a thread of their own, while the window's lives on, and keeps the last ones: another
// size of the window or another filter needs no other bake.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <string_view>

#include "shadewright/progress.h"
#include "shadewright/scene/scene.h"
#include "shadewright/voxel/bake.h"

namespace shadewright::viewer {

class Baker {
 public:
  /// Called on the calling thread several times a second while a bake runs; false gives it up. What it throws does too.
  using Watch = std::function<bool(const std::string& task, double fraction)>;

  explicit Baker(Watch watch) : watch_(std::move(watch)) {}

  /// shadow::BakeShadow. FailureError where the bake was given up.
  voxel::VoxelShadow operator()(const Scene& scene, const Light& light, const voxel::BakeOptions& options);

 private:
  struct Baked {
    std::string what;
    Light light;
    voxel::VoxelShadow shadow;
  };

  Watch watch_;
  std::deque<Baked> kept_;  ///< the last one first
};

}  // namespace shadewright::viewer
