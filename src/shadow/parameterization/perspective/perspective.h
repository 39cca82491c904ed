// perspective: perspective shadow maps (Stamminger and Drettakis, "Perspective Shadow Maps", 2002), and light space
// ones.
//
// 1. The device reduces the camera's depth to ranges of tiles; their nearest is the near plane (section 6).
// 2. Receivers are what the tiles hold; H, what may shadow them, follows from them and the light (section 4.1).
// 3. The light is seen from under the camera's perspective transform, whose eye is moved back (sections 3, 4.2).
// 4. The map is fitted tightly to the receivers' image; depth is the light's own distance.
// 5. Where a texel is not smaller in the image than that of `uniform,fit=view`, its view is taken (counter "fallback").
//
// What differs from the paper: it moves the eye back as little as H allows (shift=least); by default the shift is the
// one whose texels are smallest in the image. Depth is not the post-perspective one, so that no light is inverted, and
// it is clamped before the nearest receiver, so that resolution follows receivers and casters may be anywhere. Point
// lights have six faces, each with a projection of its own.
#pragma once

#include "shadow/parameterization/parameterization.h"
#include "shadow/parameterization/perspective/warp.h"
#include "shadow/parameterization/uniform/uniform.h"

namespace shadewright::shadow {

struct PerspectiveOptions {
  bool light_space = false;  ///< warp=lispsm
  bool least_shift = false;  ///< shift=least
  bool from_buffers = true;  ///< fit=visible; false: fit=view, which waits for nothing
};

class Perspective final : public Parameterization {
 public:
  Perspective(const gpu::Device& device, uint32_t resolution, const PerspectiveOptions& options, uint32_t width,
              uint32_t height);

  Traits traits() const override {
    return {.layered = true, .needs_readback = options_.from_buffers, .without_readback = "choose fit=view"};
  }
  uint32_t max_views() const override { return 6; }
  MapExtent map_extent(LightKind light) const override {
    return {resolution_, resolution_, light == LightKind::point ? 6u : 1u};
  }
  void prepare(const Frame& frame, gpu::Recorder& recorder) override;
  std::span<const MapView> views() const override { return views_; }
  Counters counters() const override { return counters_; }
  std::vector<Allocation> allocations() const override;

 private:
  Receivers find_receivers(const Frame& frame, gpu::Recorder& recorder);
  void choose_views(const Frame& frame, const Receivers& receivers);

  PerspectiveOptions options_;
  uint32_t resolution_;
  Uniform plain_;  ///< what is drawn instead where perspective does not help
  TileGrid grid_{};
  std::vector<MapView> views_;
  Counters counters_;
  gpu::ComputePass reduce_;
  vk::raii::Sampler sampler_{nullptr};
  gpu::Buffer camera_, tiles_;
};

}  // namespace shadewright::shadow
