// perspective: perspective shadow maps (Stamminger and Drettakis, "Perspective Shadow Maps", 2002), light space ones,
// and the best projective map.
//
// 1. The device reduces what the camera sees of surfaces that face the light to bounds of tiles; their nearest is the
//    near plane (section 6). What no caster may shadow is left out.
// 2. The matrix. warp=best: of all projections of the light's plane, the one with the smallest texels, by search
//    (light_plane.h). warp=psm: the light is seen from under the camera's perspective transform, whose eye is moved
//    back (sections 3, 4.2); H, what may shadow the receivers, follows from them and the light (section 4.1).
// 3. The map is fitted tightly to the receivers' image; depth is the light's own distance.
// 4. Where a texel is not smaller than that of `uniform,fit=view`, its view is taken (counter "fallback"), but for
//    fallback=off, which shows a projection as it is.
//
// What differs from the paper: PSM's projections are some of those that the search chooses from, so `best` is the
// default. PSM moves the eye back as little as H allows (shift=least); by default the shift is the one whose texels are
// smallest. Depth is not the post-perspective one, so that no light is inverted. The near plane of the map comes from
// the receivers and casters before it are clamped to it: their order there does not matter, since all of them are
// before every receiver; so a light inside the scene needs no cut of H at its nearest caster, and resolution follows
// receivers wherever casters are. Point lights have six faces, each with a projection of its own.
#pragma once

#include "shadow/parameterization/parameterization.h"
#include "shadow/parameterization/perspective/warp.h"
#include "shadow/parameterization/uniform/uniform.h"

namespace shadewright::shadow {

struct PerspectiveOptions {
  WarpKind warp = WarpKind::best;
  bool least_shift = false;  ///< shift=least
  bool from_buffers = true;  ///< fit=visible; false: fit=view, which waits for nothing
  FilterReach reach{};       ///< what look-ups read around a receiver, across faces of a point light too
  bool soft = false;         ///< what they read there darkens it
  bool falls_back = true;    ///< fallback=on
};

class Perspective final : public Parameterization {
 public:
  Perspective(const gpu::Device& device, uint32_t resolution, const PerspectiveOptions& options, uint32_t width,
              uint32_t height);

  Traits traits() const override {
    return {.layered = true, .needs_readback = options_.from_buffers, .without_readback = "choose fit=view"};
  }
  MapExtent map_extent(LightKind light) const override {
    return {resolution_, resolution_, light == LightKind::point ? 6u : 1u};
  }
  void prepare(const Frame& frame, gpu::Recorder& recorder) override;
  std::span<const MapView> views() const override { return views_; }
  Counters counters() const override { return counters_; }
  std::vector<Allocation> allocations() const override;
  std::vector<std::string> debug_names() const override { return {"aliasing"}; }
  Picture debug_picture(std::string_view, const ReceiverLookup& lookup) override;

 private:
  /// Makes the pass over the camera's buffers for the first frame, or a light of another kind.
  void make_reduction(LightKind light);
  Receivers find_receivers(const Frame& frame, gpu::Recorder& recorder);
  void choose_views(const Frame& frame, const Receivers& receivers);

  const gpu::Device& device_;
  PerspectiveOptions options_;
  uint32_t resolution_;
  Uniform plain_;  ///< what is drawn instead where perspective does not help
  TileGrid grid_{};
  std::vector<MapView> views_;
  Counters counters_;
  gpu::ComputePass reduce_;
  std::optional<LightKind> reduces_for_;
  vk::raii::Sampler sampler_{nullptr};
  gpu::Buffer camera_, tiles_;
};

}  // namespace shadewright::shadow
