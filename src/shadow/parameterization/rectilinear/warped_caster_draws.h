// Draws casters into a warped map, where straight edges bend. Cut (the default): every cluster is drawn once for each
// pair of the warp's segments that it touches, in which the warp is linear, clipped at their borders: exact, by a plain
// pass. As the paper does (tessellation=off|5|2.5|1): vertices are warped, long edges tessellated, and depth comes from
// the fragment stage, for those clusters whose triangles bend.
#pragma once

#include "shadow/view_caster_draws.h"

namespace shadewright::shadow {

class WarpedCasterDraws final : public ViewCasterDraws {
 public:
  explicit WarpedCasterDraws(uint32_t frames_in_flight) : ViewCasterDraws(1, frames_in_flight) {}

  /// True if `spec` asks for the paper's way.
  static bool bends(const Spec& spec) { return spec.choice("tessellation") != "exact"; }
  /// True if `spec` has edges cut to a length.
  static bool tessellates(const Spec& spec) { return bends(spec) && spec.choice("tessellation") != "off"; }

  void make_pipelines(const gpu::Device& device, const CasterPipelineDesc& desc) override;
  void prepare(const Frame& frame, uint32_t slot, std::span<const MapView> views) override;
  void cull(const Frame& frame, uint32_t slot, const ReceiverLookup& lookup, gpu::Recorder& recorder) override;
  Counters counters() const override;
  std::vector<Allocation> allocations() const override;

 private:
  /// Pieces of a cluster share its indices.
  bool compacts() const override { return false; }
  void draw_scene(const vk::raii::CommandBuffer& commands, uint32_t index, vk::DescriptorSet lookup_set) const override;
  void make_buffers(uint32_t spare);

  const gpu::Device* device_ = nullptr;
  bool bends_ = false;
  gpu::ComputePass part_;
  gpu::GraphicsPass rest_pass_;  ///< of what bends; else of pieces for which there was no room
  gpu::Buffer pieces_, piece_segments_, piece_draws_, rest_draws_, figures_;
  uint32_t spare_ = 0;  ///< room in `pieces_` for what is cut
};

}  // namespace shadewright::shadow
