// Draws a frame's casters into one view of a map: the scene's, culled, and the caller's own. Shared by the storages,
// which bring attachments and pipeline.
#pragma once

#include <optional>

#include "shadewright/render/scene_gpu.h"
#include "shadewright/shadow/technique.h"

namespace shadewright::shadow {

class CasterDraws {
 public:
  CasterDraws(uint32_t max_views, uint32_t frames_in_flight)
      : max_views_(max_views), frames_in_flight_(frames_in_flight) {}

  /// The vertex input, sets and constants of a pipeline that `draw` uses; shaders and attachments are the storage's.
  static void describe(gpu::GraphicsDesc& desc, vk::DescriptorSetLayout lookup_layout);

  /// Host work of a frame: which clusters each view draws.
  void prepare(const Frame& frame, uint32_t slot, std::span<const MapView> views);
  /// Records the stage "shadow cull".
  void cull(const Frame& frame, uint32_t slot, gpu::Recorder& recorder) const;
  /// Draws every drawn view into its layer of `depth`, which is cleared to 1, and of `colors`, which are not cleared: a
  /// texel whose depth is 1 is empty, whatever its colors. All images are left in shader-read layout.
  void draw_views(const vk::raii::CommandBuffer& commands, const Frame& frame, std::span<const MapView> views,
                  gpu::Image& depth, std::span<gpu::Image> colors, const gpu::GraphicsPass& pass,
                  vk::DescriptorSet lookup_set) const;
  /// Sets the view's viewport and draws, inside a rendering that the storage has begun.
  void draw(const vk::raii::CommandBuffer& commands, const Frame& frame, const MapView& view, uint32_t index,
            const gpu::GraphicsPass& pass, vk::DescriptorSet lookup_set) const;

  std::vector<Allocation> allocations() const;

 private:
  uint32_t max_views_, frames_in_flight_;
  std::optional<render::CulledDraws> draws_;
  const render::SceneGpu* scene_ = nullptr;  ///< whose draws these are
};

}  // namespace shadewright::shadow
