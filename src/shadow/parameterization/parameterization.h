// What a parameterization answers on the CPU; its GLSL module answers the same on the device (architecture, section 1).
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "shadewright/gpu/pass.h"
#include "shadewright/shadow/technique.h"
#include "shadow/shared.h"

namespace shadewright::shadow {

/// What a combination may rely on.
struct Traits {
  bool projective = true;   ///< straight edges stay straight in the map
  bool contiguous = true;   ///< neighbouring texels are neighbours in the world
  bool layered = false;     ///< more than one view at once
  bool gpu_driven = false;  ///< views are a buffer on the device
  bool needs_readback = false;
  std::string_view without_readback;  ///< what to choose where readback is forbidden
};

/// How a compute shader asks about the receivers of a frame as the look-up does (shadow/receivers.glsl).
struct ReceiverLookup {
  vk::DescriptorSetLayout layout;  ///< set 1
  vk::DescriptorSet set;
  std::vector<gpu::Binding> receivers;  ///< bindings 0, 1, 2 of set 0
  uint32_t width = 0, height = 0;
  uint32_t light_kind = shared::light_any;  ///< specialization constant 0 of look-ups
};

/// The size of a map, texels and layers.
struct MapExtent {
  uint32_t width = 0, height = 0, layers = 1;
  bool operator==(const MapExtent&) const = default;
};

/// The first bindings of a parameterization's and of a storage's own resources in the look-up's set.
inline constexpr uint32_t parameterization_binding = 1, storage_binding = 8;

class CasterDraws;

class Parameterization {
 public:
  virtual ~Parameterization() = default;
  virtual Traits traits() const = 0;
  /// The map that a light of this kind needs.
  virtual MapExtent map_extent(LightKind light) const = 0;
  /// What draws the casters of its frames into the map of a light of this kind: unless it does better, the scene's
  /// casters, culled for each of `views`.
  virtual std::unique_ptr<CasterDraws> make_caster_draws(LightKind light, uint32_t frames_in_flight);
  /// Finds the frame's views. May submit and wait if it says so in its traits.
  virtual void prepare(const Frame& frame, gpu::Recorder& recorder) = 0;
  /// Finds what `record` can't, with the help of maps: `draw` culls and draws the casters as things stand. Called after
  /// `prepare`; may submit and wait if it says so in its traits.
  virtual void refine(const Frame&, const ReceiverLookup&, gpu::Recorder&, const std::function<void()>& /*draw*/) {}
  /// Records what must run on the device before casters are culled.
  virtual void record(const Frame&, const ReceiverLookup&, gpu::Recorder&) {}
  /// Of the last prepared frame; at most shared::max_map_views.
  virtual std::span<const MapView> views() const = 0;

  /// Kinds of what its GLSL module reads besides the views, bound from `parameterization_binding` on.
  virtual std::vector<gpu::BindingKind> lookup_kinds() const { return {}; }
  /// Those resources for the frames of `slot`; they stay the same as long as the map's extent does.
  virtual std::vector<gpu::Binding> lookup_bindings(uint32_t /*slot*/) const { return {}; }
  /// What its GLSL module may know already when a look-up is compiled: specialization constant 3. 0: nothing.
  virtual uint32_t lookup_constant() const { return 0; }

  virtual Counters counters() const = 0;
  virtual std::vector<Allocation> allocations() const { return {}; }
  virtual std::vector<std::string> debug_names() const { return {}; }
  /// The debug picture of a name that is one of `debug_names`, of the last recorded frame. Waits.
  virtual Picture debug_picture(std::string_view, const ReceiverLookup&) { return {}; }
};

/// The parameterization that `spec` names.
std::unique_ptr<Parameterization> make_parameterization(const gpu::Device& device, const Spec& spec,
                                                        const TechniqueOptions& options);

}  // namespace shadewright::shadow
