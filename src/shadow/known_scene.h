// The scene that something was made for.
#pragma once

#include "shadewright/render/scene_gpu.h"

namespace shadewright::shadow {

/// Scenes are compared by address, since what was made for one refers to it, and by generation, since a new one may
/// stand where an old one was.
class KnownScene {
 public:
  KnownScene() = default;
  explicit KnownScene(const render::SceneGpu* scene) : scene_(scene), generation_(scene ? scene->generation() : 0) {}
  bool operator==(const KnownScene&) const = default;
  const render::SceneGpu* operator->() const { return scene_; }

 private:
  const render::SceneGpu* scene_ = nullptr;
  uint64_t generation_ = 0;
};

}  // namespace shadewright::shadow
