// Draws a frame's casters into the targets of a map. What the targets are, which casters each of them gets, and by
// which pipelines, belongs together: a parameterization brings its own (Parameterization::make_caster_draws) or takes
// ViewCasterDraws. The storage brings images and shader stages.
#pragma once

#include <span>
#include <vector>

#include "shadewright/gpu/pass.h"
#include "shadewright/render/scene_gpu.h"
#include "shadewright/shadow/technique.h"
#include "shadow/parameterization/parameterization.h"

namespace shadewright::shadow {

/// What a storage asks of the pipelines that draw casters.
struct CasterPipelineDesc {
  const Spec& spec;  ///< of the technique, which outlives the draws; names the storage's stages, see casters_shaders
  vk::DescriptorSetLayout lookup_layout;                       ///< set 1
  std::vector<vk::Format> colors;                              ///< of attachments besides depth (D32)
  render::SceneInputs inputs = render::SceneInputs::position;  ///< what the storage's vertex stage reads
  bool sides =
      false;  ///< whether it draws one side of closed bodies and asks for silhouettes (storage/subpixel/side.glsl)
  MapExtent extent = {};  ///< of the targets
};

class CasterDraws {
 public:
  virtual ~CasterDraws() = default;

  /// Makes the pipelines that `draw` uses; once, before all else.
  virtual void make_pipelines(const gpu::Device& device, const CasterPipelineDesc& desc) = 0;
  /// Host work of a frame: what is drawn into `views`, the parameterization's. They stay as they are until the next
  /// call.
  virtual void prepare(const Frame& frame, uint32_t slot, std::span<const MapView> views) = 0;
  /// Records the stages that find on the device what is drawn.
  virtual void cull(const Frame& frame, uint32_t slot, const ReceiverLookup& lookup, gpu::Recorder& recorder) = 0;
  /// What is drawn into, one after the other; those not `drawn` are left out.
  virtual std::span<const MapView> targets() const = 0;
  /// Draws into target `index`, inside a rendering that the storage has begun.
  virtual void draw(const vk::raii::CommandBuffer& commands, const Frame& frame, uint32_t index,
                    vk::DescriptorSet lookup_set) const = 0;
  virtual std::vector<Allocation> allocations() const = 0;
  virtual Counters counters() const { return {}; }

  /// True if a target keeps what it held in the last frame, but for what `draw` empties and draws anew.
  virtual bool keeps() const { return false; }
  /// Whether `layer` holds what was drawn: else it is undefined.
  bool holds(uint32_t layer) const;
  /// Device work before the rendering of target `index`.
  virtual void before(const vk::raii::CommandBuffer& /*commands*/, const Frame&, uint32_t /*index*/,
                      vk::DescriptorSet /*lookup_set*/) const {}
  /// Draws every drawn target into its layer of `depth`, which is cleared to 1 unless it keeps, and of `colors`, which
  /// are not cleared: a texel whose depth is 1 is empty, whatever its colors. All images are left in shader-read
  /// layout. Layers without a drawn target stay undefined.
  void draw_targets(const vk::raii::CommandBuffer& commands, const Frame& frame, gpu::Image& depth,
                    std::span<gpu::Image> colors, vk::DescriptorSet lookup_set) const;
};

}  // namespace shadewright::shadow
