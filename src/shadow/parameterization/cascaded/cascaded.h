// cascaded: slices of the camera's view along its depth, each with a map of its own fitted to what receives there.
// Zhang et al., "Parallel-Split Shadow Maps for Large-scale Virtual Environments" (VRCIA 2006); Lauritzen, Salvi and
// Lefohn, "Sample Distribution Shadow Maps" (I3D 2011); stable as in Valient, "Stable Rendering of Cascaded Shadow
// Maps" (ShaderX6, 2008).
//
// splits=pssm  the range to split runs from the nearest to the farthest receiver, each slice is fitted as by uniform
// splits=sdsm  range and slices are fitted to the visible surface points, reduced on the device and read back
// stable=1     maps move by whole texels, so that a moving camera does not shimmer; their size and turn stay from frame
//              to frame while they hold the slice's receivers and are little larger than they must be
// What differs from the papers: a receiver takes the first cascade that holds it, not that of its slice; all cascades
// share one depth range, so that only its place across the light decides.
#pragma once

#include <optional>

#include "shadow/filter/reach.h"
#include "shadow/parameterization/cascaded/shared.h"
#include "shadow/parameterization/cascaded/slices.h"
#include "shadow/parameterization/parameterization.h"
#include "shadow/parameterization/visible_bounds.h"

namespace shadewright::shadow {

class Cascaded final : public Parameterization {
 public:
  Cascaded(const gpu::Device& device, const Spec& spec, uint32_t frames_in_flight);

  Traits traits() const override;
  MapExtent map_extent(LightKind) const override { return {resolution_, resolution_, cascades_}; }
  void prepare(const Frame& frame, gpu::Recorder& recorder) override;
  std::span<const MapView> views() const override { return views_; }
  /// How near to each map's edge a receiver may lie, uv.
  const std::vector<glm::vec2>& borders() const { return borders_; }
  std::vector<gpu::BindingKind> lookup_kinds() const override { return {gpu::BindingKind::uniform_buffer}; }
  std::vector<gpu::Binding> lookup_bindings(uint32_t slot) const override {
    return {gpu::Binding::uniform(constants_[slot])};
  }
  uint32_t lookup_constant() const override { return cascades_; }
  Counters counters() const override;
  std::vector<Allocation> allocations() const override;
  std::vector<std::string> debug_names() const override { return {"cascades"}; }
  /// Which cascade each pixel takes: red, green, blue, yellow, ... from the finest; magenta: none holds it.
  Picture debug_picture(std::string_view name, const ReceiverLookup& lookup) override;

 private:
  /// What was chosen for a stable map, kept from frame to frame.
  struct SteadyWindow {
    LightFrame turned_from;  ///< the light's own
    LightFrame light;
    glm::dvec2 half{0};  ///< size across the light
  };
  /// The range to split, which seldom changes (stable).
  DepthRange steady_range(const DepthRange& range);
  /// Takes the window that was kept in place of one turned and fitted to the receivers at `points`, or keeps that one
  /// (stable). `light` is not turned.
  static void hold_steady(SteadyWindow& steady, const LightFrame& light, std::span<const glm::dvec3> points,
                          LightFrame& turned, Box& receivers);
  /// The view that holds `receivers`, whose depths are those of every slice, and what filters read around them.
  MapView make_view(const LightFrame& light, Box receivers, glm::vec2& border) const;
  void write_constants(const LightFrame& light, shared::CascadeData& constants) const;

  const gpu::Device& device_;
  uint32_t resolution_, cascades_;
  double lambda_;
  bool stable_;
  FilterReach reach_;
  std::optional<VisibleBounds> visible_;  ///< splits=sdsm
  std::vector<gpu::Buffer> constants_;    ///< by slot, host-written
  std::vector<SteadyWindow> steady_;      ///< by cascade
  DepthRange steady_range_{1, 0};
  std::vector<DepthRange> slices_;
  std::vector<MapView> views_;
  std::vector<glm::vec2> borders_;
};

}  // namespace shadewright::shadow
