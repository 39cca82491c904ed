// A technique made of the three axes: parameterization, storage, filter.
#pragma once

#include <optional>

#include "shadow/decisions.h"
#include "shadow/lookup_passes.h"
#include "shadow/lookup_sets.h"
#include "shadow/parameterization/parameterization.h"
#include "shadow/storage/storage.h"

namespace shadewright::shadow {

class MapTechnique final : public Technique {
 public:
  MapTechnique(const gpu::Device& device, const Spec& spec, const TechniqueOptions& options);

  using Technique::record;
  void prepare(const Frame& frame, gpu::Recorder& recorder) override;
  void record(const Frame& frame, gpu::Recorder& recorder) override;

  bool needs_readback() const override { return parameterization_->traits().needs_readback; }
  gpu::Image& visibility() override { return visibility_; }
  std::vector<Allocation> allocations() const override;
  Counters counters() const override;
  std::span<const MapView> views() const override { return parameterization_->views(); }
  vk::DescriptorSetLayout lookup_layout() const override { return lookup_sets_.layout(); }
  vk::DescriptorSet lookup_set(const Frame& frame) const override { return lookup_sets_.set(slot(frame)); }
  std::vector<std::string> lookup_includes() const override;
  std::vector<uint32_t> lookup_constants() const override;
  std::optional<OracleRays> oracle_rays(const Frame& frame) override;
  std::vector<std::string> debug_names() const override;
  Picture debug_picture(std::string_view name) override;

 private:
  uint32_t slot(const Frame& frame) const { return static_cast<uint32_t>(frame.index % options_.frames_in_flight); }
  /// Makes map and look-up when the first frame, or a light of another kind, needs them.
  void build_for(LightKind light);
  void write_lookup_sets();
  void write_constants(const Frame& frame);
  /// Culls the casters and draws them into the map.
  void draw(const Frame& frame, gpu::Recorder& recorder);
  ReceiverLookup receiver_lookup(const Frame& frame) const;
  /// How the receivers of the last recorded frame were decided, see decisions.h. Waits.
  std::vector<uint32_t> last_decisions() const;

  Spec spec_;
  TechniqueOptions options_;
  std::unique_ptr<Parameterization> parameterization_;
  gpu::Image visibility_;
  vk::raii::Sampler sampler_{nullptr};
  std::vector<gpu::Buffer> cameras_, lookups_;  ///< by slot, host-written
  LookupSets lookup_sets_;
  std::unique_ptr<CasterDraws> draws_;
  std::unique_ptr<Storage> storage_;
  std::optional<LightKind> built_for_;
  LookupPasses lookup_;
  ReceiverLookup last_;  ///< of the last prepared frame
};

}  // namespace shadewright::shadow
