// Draws casters into the pages of a pool as RMSM does (section 3.3.3): for each superpage that holds a page to draw one
// culled pass over the scene into a scratch map, out of which its pages are copied.
#pragma once

#include <memory>
#include <optional>

#include "shadow/caster_draws.h"
#include "shadow/known_scene.h"
#include "shadow/parameterization/paged/superpages.h"

namespace shadewright::shadow {

class Paged;

class SuperpageCasterDraws final : public CasterDraws {
 public:
  SuperpageCasterDraws(const gpu::Device& device, const Paged& paged, uint32_t frames_in_flight);

  void make_pipelines(const gpu::Device& device, const CasterPipelineDesc& desc) override;
  /// InputError for a frame with casters of the caller's own.
  void prepare(const Frame& frame, uint32_t slot, std::span<const MapView> views) override;
  void cull(const Frame& frame, uint32_t slot, const ReceiverLookup& lookup, gpu::Recorder& recorder) override;
  std::span<const MapView> targets() const override { return targets_; }
  bool keeps() const override { return true; }
  void before(const vk::raii::CommandBuffer& commands, const Frame& frame, uint32_t index,
              vk::DescriptorSet lookup_set) const override;
  void draw(const vk::raii::CommandBuffer& commands, const Frame& frame, uint32_t index,
            vk::DescriptorSet lookup_set) const override;
  std::vector<Allocation> allocations() const override;

 private:
  /// Makes room to cull the scene for so many superpages.
  void reserve(const render::SceneGpu& scene, size_t superpages);
  /// Where CulledDraws keeps the views of a batch.
  uint32_t cull_slot(uint32_t batch) const { return slot_ * batches_ + batch; }

  const Paged& paged_;
  uint32_t frames_in_flight_, slot_ = 0;
  std::vector<MapView> targets_;  ///< the pool, once for each superpage
  KnownScene scene_;
  uint32_t batch_size_ = 0, batches_ = 0;
  std::optional<render::CulledDraws> culled_;  ///< by batch: all at once would take much memory
  gpu::GraphicsPass casters_pass_, copy_pass_;
  std::unique_ptr<gpu::Image> superpage_;  ///< drawing, which changes its layout, is const
  vk::raii::Sampler sampler_{nullptr};
};

}  // namespace shadewright::shadow
