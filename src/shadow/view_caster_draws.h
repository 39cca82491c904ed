// The scene's casters, culled for each of a list of views, and the caller's own.
#pragma once

#include <optional>

#include "shadow/caster_draws.h"

namespace shadewright::shadow {

class ViewCasterDraws : public CasterDraws {
 public:
  ViewCasterDraws(uint32_t max_views, uint32_t frames_in_flight)
      : max_views_(max_views), frames_in_flight_(frames_in_flight) {}

  void make_pipelines(const gpu::Device& device, const CasterPipelineDesc& desc) override;
  void prepare(const Frame& frame, uint32_t slot, std::span<const MapView> views) override;
  void cull(const Frame& frame, uint32_t slot, const ReceiverLookup& lookup, gpu::Recorder& recorder) override;
  std::span<const MapView> targets() const override { return views_; }
  void draw(const vk::raii::CommandBuffer& commands, const Frame& frame, uint32_t index,
            vk::DescriptorSet lookup_set) const override;
  std::vector<Allocation> allocations() const override;

 protected:
  /// The pipeline's description, for a parameterization that makes further ones like it.
  static gpu::GraphicsDesc describe(const CasterPipelineDesc& desc);
  /// What render/scene_neighbours.glsl declares, if the storage asked for it; `visible` holds what is drawn.
  std::vector<gpu::Binding> neighbours(const gpu::Buffer& visible) const;
  /// Draws the scene's casters into target `index`.
  virtual void draw_scene(const vk::raii::CommandBuffer& commands, uint32_t index, vk::DescriptorSet lookup_set) const;

  std::optional<render::CulledDraws> draws_;
  const render::SceneGpu* scene_ = nullptr;  ///< whose draws these are
  gpu::GraphicsPass pass_;
  bool neighbours_ = false;  ///< whether its geometry stage reads what lies across edges

 private:
  uint32_t max_views_, frames_in_flight_;
  std::span<const MapView> views_;
};

}  // namespace shadewright::shadow
