// Draws casters into the pages of a pool: all (triangle, page) pairs, found on the device, by one draw; by more, in
// rounds, if there are more pairs than room.
#pragma once

#include "shadow/caster_draws.h"
#include "shadow/known_scene.h"
#include "shadow/parameterization/paged/shared.h"

namespace shadewright::shadow {

class Paged;

class PagedCasterDraws final : public CasterDraws {
 public:
  PagedCasterDraws(const gpu::Device& device, const Paged& paged, LightKind light);

  void make_pipelines(const gpu::Device& device, const CasterPipelineDesc& desc) override;
  /// InputError for a frame with casters of the caller's own.
  void prepare(const Frame& frame, uint32_t slot, std::span<const MapView> views) override;
  void cull(const Frame& frame, uint32_t slot, const ReceiverLookup& lookup, gpu::Recorder& recorder) override;
  std::span<const MapView> targets() const override { return rounds_; }
  bool keeps() const override { return true; }
  void before(const vk::raii::CommandBuffer& commands, const Frame& frame, uint32_t index,
              vk::DescriptorSet lookup_set) const override;
  void draw(const vk::raii::CommandBuffer& commands, const Frame& frame, uint32_t index,
            vk::DescriptorSet lookup_set) const override;
  std::vector<Allocation> allocations() const override;

 private:
  void make_buffers(const render::SceneGpu& scene);
  void bin(const vk::raii::CommandBuffer& commands, const Frame& frame, uint32_t round,
           vk::DescriptorSet lookup_set) const;

  const gpu::Device& device_;
  const Paged& paged_;
  LightKind light_;
  std::vector<MapView> rounds_;
  KnownScene scene_;  ///< whom the buffers were made for
  shared::BinConstants constants_{};
  bool sides_ = false;  ///< whether the storage asks for triangles' sides, and draws all kinds of pairs by one pipeline
  gpu::GraphicsPass passes_[shared::pair_kinds], clear_pass_;
  gpu::ComputePass cull_pass_, groups_pass_, bin_pass_, command_pass_;
  gpu::Buffer touched_, late_, pairs_, corners_;
};

}  // namespace shadewright::shadow
