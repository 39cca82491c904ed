// rectilinear: Rectilinear Texture Warping (Rosen, "Rectilinear Texture Warping for Fast Adaptive Shadow Mapping", I3D
// 2012): the light's image plane stretched along its two axes, by how much resolution its rows and columns deserve.
//
// What differs from the paper:
// - Backward analysis accumulates rows and columns straight from the camera's pixels, without a two-dimensional
//   importance map (its section 4.1); nothing is read back.
// - The light's image plane is turned: to where what may receive fits tightest, or (rotate) to the orientation with the
//   least expected error (its future work, section 7). The super-cells cover just what receives in this frame.
// - A row's share may follow from the sum of its samples (collapse=sum) instead of their maximum, and importance from
//   the pixels that a step of the map covers (px) instead of distance and normal.
// - Super-cells that deserve about the same make one segment of the warp (segments), whose borders lie between texels:
//   casters are cut there and drawn without error, instead of tessellated (its section 6.1).
// - Where the warp is expected to be worse than none, there is none.
#pragma once

#include <optional>

#include "shadow/parameterization/parameterization.h"
#include "shadow/parameterization/rectilinear/light_image.h"
#include "shadow/parameterization/uniform/fit.h"

namespace shadewright::shared {
struct WarpConstants;
}

namespace shadewright::shadow {

class Rectilinear final : public Parameterization {
 public:
  Rectilinear(const gpu::Device& device, const Spec& spec, const TechniqueOptions& options);

  Traits traits() const override { return {.projective = false, .without_readback = {}}; }
  MapExtent map_extent(LightKind) const override { return {resolution_, resolution_, 1}; }
  std::unique_ptr<CasterDraws> make_caster_draws(LightKind light, uint32_t frames_in_flight) override;
  void prepare(const Frame& frame, gpu::Recorder& recorder) override;
  void record(const Frame& frame, const ReceiverLookup& receivers, gpu::Recorder& recorder) override;
  std::span<const MapView> views() const override { return {&view_, 1}; }
  std::vector<gpu::BindingKind> lookup_kinds() const override;
  std::vector<gpu::Binding> lookup_bindings(uint32_t slot) const override;
  uint32_t lookup_constant() const override;
  Counters counters() const override;
  std::vector<std::string> debug_names() const override { return {"importance", "warps", "grid"}; }
  /// Figure 5 of the paper: importance by rows and columns (and in two dimensions, where there is such a map), how far
  /// each place is moved, and where the super-cells' borders lie in the map.
  Picture debug_picture(std::string_view name, const ReceiverLookup&) override;
  std::vector<Allocation> allocations() const override;

 private:
  void fit(const Frame& frame);
  void make_passes(const ReceiverLookup& receivers);
  void record_analysis(const Frame& frame, const ReceiverLookup& receivers, gpu::Recorder& recorder);
  uint32_t slot(const Frame& frame) const { return static_cast<uint32_t>(frame.index % constants_.size()); }

  const gpu::Device& device_;
  Spec spec_;
  uint32_t resolution_, cells_;
  MapView view_;
  std::vector<gpu::Buffer> constants_;  ///< by slot, host-written
  gpu::Buffer accumulated_, edges_, importance_map_, warp_, flats_, history_, figures_;
  gpu::ComputePass orient_, importance_, forward_, collapse_, build_, unwarp_;
  std::optional<LightImage> light_image_;  ///< of forward and hybrid analysis
  bool backward_ = true, two_dimensional_ = false;
  uint32_t functions_ = 0, collapse_mode_ = 0;  ///< constants that the passes are specialized for
  std::optional<Light> last_light_;             ///< of the frame that the history is of
};

}  // namespace shadewright::shadow
