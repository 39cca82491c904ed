// uniform: one matrix, fitted tightly to what receives shadows; six faces for point lights. The baseline of every paper
// here.
//
// fit=scene   receivers are all of the scene (what the papers call conventional)
// fit=view    receivers are what the camera's frustum holds of each instance's bounds
// fit=visible receivers are the surface points of this frame, reduced on the device and read back
// Casters between the light and the receivers count from anywhere: their depth is clamped to the map's range.
#pragma once

#include <optional>

#include "shadow/parameterization/parameterization.h"
#include "shadow/parameterization/uniform/fit.h"
#include "shadow/parameterization/visible_bounds.h"

namespace shadewright::shadow {

class Uniform final : public Parameterization {
 public:
  /// `fit` is "scene", "view" or "visible"; look-ups read `reach` around a receiver, across faces of a point light too.
  Uniform(const gpu::Device& device, uint32_t resolution, std::string_view fit, const FilterReach& reach);

  Traits traits() const override {
    return {.layered = true, .needs_readback = fit_ == "visible", .without_readback = "choose fit=view"};
  }
  MapExtent map_extent(LightKind light) const override {
    return {resolution_, resolution_, light == LightKind::point ? 6u : 1u};
  }
  void prepare(const Frame& frame, gpu::Recorder& recorder) override;
  std::span<const MapView> views() const override { return views_; }
  Counters counters() const override;
  std::vector<Allocation> allocations() const override;

 private:
  std::string fit_;
  uint32_t resolution_;
  FilterReach reach_;
  std::vector<MapView> views_;
  std::optional<VisibleBounds> visible_;  ///< fit=visible
};

}  // namespace shadewright::shadow
