// precomputed: a light's shadow baked into a voxel DAG, looked up on the device (CPVS 2014, sections 5 and 6.2).
//
// The first frame of a light bakes it, or opens the file that the spec names; the DAG's words go to the device once. A
// frame then costs one pass over the camera's points: see precomputed.glsl for the walk.
// far=mraa and far=voaa look distant receivers up in coarser DAGs or by occupancy (section 5).
// dynamic=(SPEC) adds a map technique that draws moving instances only: the least of both is what is lit.
//
// Differs from the paper: a filter's leaves are grouped by their parents, so that one rule serves all sizes up to
// 17 x 17 where the paper has two orders for 9 x 9 and a table of eight for 17 x 17; the steps are the same. On a CPU
// device each leaf is walked on its own. Distant receivers move towards the light, not along the normal.
#pragma once

#include <memory>
#include <optional>

#include "shadewright/gpu/pass.h"
#include "shadewright/shadow/technique.h"
#include "shadewright/voxel/shadow.h"
#include "shadow/lookup_sets.h"

namespace shadewright::shadow {

/// Opens the file that `spec` names and moves it to where `scene`, if not null, has its zero. InputError where it does
/// not fit the spec or `light`.
voxel::VoxelShadow open_baked(const Spec& spec, const Scene* scene, const Light& light);

class Precomputed final : public Technique {
 public:
  /// InputError where neither a scene to bake nor a file is given.
  Precomputed(const gpu::Device& device, const Spec& spec, const TechniqueOptions& options);
  ~Precomputed() override;

  using Technique::record;
  void prepare(const Frame& frame, gpu::Recorder& recorder) override;
  void record(const Frame& frame, gpu::Recorder& recorder) override;

  bool needs_readback() const override { return moving_ && moving_->needs_readback(); }
  gpu::Image& visibility() override { return visibility_; }
  std::vector<Allocation> allocations() const override;
  Counters counters() const override;
  vk::DescriptorSetLayout lookup_layout() const override { return lookup_sets_.layout(); }
  vk::DescriptorSet lookup_set(const Frame& frame) const override { return lookup_sets_.set(slot(frame)); }
  std::vector<std::string> lookup_includes() const override { return {"shadow/precomputed/precomputed.glsl"}; }
  std::vector<std::string> lookup_defines() const override;
  std::vector<uint32_t> lookup_constants() const override { return {variant_}; }

  /// What is looked up: that of the last prepared frame's light.
  const voxel::VoxelShadow& shadow() const { return shadow_; }
  /// Looks `shadow` up from now on, whatever the spec says of baking. Waits.
  void use(voxel::VoxelShadow shadow, const Light& light);

 private:
  /// How the look-up reads the DAG's words.
  enum class Access { windows, image, address };
  /// The words on the device, in one of three forms.
  struct Words {
    std::vector<gpu::Buffer> buffers;  ///< windows, or one with an address
    gpu::Buffer address;
    gpu::Image image;
  };

  uint32_t slot(const Frame& frame) const { return static_cast<uint32_t>(frame.index % options_.frames_in_flight); }
  void bake_or_open(const Light& light);
  Access choose_access(uint64_t words) const;
  void upload_words(std::span<const uint32_t> words);
  void make_sets();
  void make_pass();
  void write_constants(const Frame& frame);
  std::vector<gpu::Binding> word_bindings() const;

  Spec spec_;
  TechniqueOptions options_;
  bool double_precision_;
  std::unique_ptr<Technique> moving_;
  voxel::VoxelShadow shadow_;
  std::optional<Light> light_;  ///< whose shadow that is
  double bake_seconds_ = 0;
  gpu::Image visibility_;
  vk::raii::Sampler sampler_{nullptr};
  Access access_ = Access::windows;
  Words words_;
  uint32_t variant_ = 1;                                 ///< precomputed.glsl's specialization constant
  std::vector<gpu::Buffer> cameras_, constants_, rows_;  ///< by slot, host-written
  LookupSets lookup_sets_;
  gpu::ComputePass pass_;
};

}  // namespace shadewright::shadow
