// The scene's casters, culled for each of a list of views, and the caller's own.
#pragma once

#include <optional>

#include "shadow/caster_draws.h"
#include "shadow/caster_sides.h"
#include "shadow/known_scene.h"
#include "shadow/storage/subpixel/small_casters.h"

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
  void before(const vk::raii::CommandBuffer& commands, const Frame& frame, uint32_t index,
              vk::DescriptorSet lookup_set) const override;
  std::vector<Allocation> allocations() const override;

 protected:
  /// The pipeline's description, for a parameterization that makes further ones like it.
  static gpu::GraphicsDesc describe(const CasterPipelineDesc& desc);
  /// Finds the triangles' sides before each drawing, if the storage asks for them.
  void ask_for_sides(const CasterPipelineDesc& desc);
  /// What the storage's geometry stage reads, if it asked for the triangles' sides; `visible` holds what is drawn.
  std::vector<gpu::Binding> sides(const gpu::Buffer& visible) const;
  /// Whether triangles that are not drawn may be left out of the clusters' indices.
  virtual bool compacts() const { return true; }
  /// Draws the scene's casters into target `index`.
  virtual void draw_scene(const vk::raii::CommandBuffer& commands, uint32_t index, vk::DescriptorSet lookup_set) const;

  std::optional<render::CulledDraws> draws_;
  KnownScene scene_;  ///< whose draws these are
  gpu::GraphicsPass pass_;

 private:
  void make_draws(const render::SceneGpu& scene);

  uint32_t max_views_, frames_in_flight_;
  std::optional<CasterPipelineDesc> sides_desc_;  ///< of the storage, if it asks for sides
  std::optional<CasterSides> sides_;
  std::optional<SmallCasters> small_;
  std::span<const MapView> views_;
};

}  // namespace shadewright::shadow
