// How the receivers of a frame were decided, for storages whose look-up tells (STORAGE_DECISIONS in its GLSL module):
// counters and a debug picture (SPSM figure 14).
#pragma once

#include <vector>

#include "shadewright/shadow/technique.h"
#include "shadow/parameterization/parameterization.h"

namespace shadewright::shadow {

class Decisions {
 public:
  /// `names` of the decisions from 1 on.
  Decisions(const gpu::Device& device, std::vector<std::string> names, uint32_t frames_in_flight);

  /// What the look-up counts into.
  gpu::Binding binding() const { return gpu::Binding::storage(counts_); }
  /// Recorded before the look-up and after it.
  void clear(const vk::raii::CommandBuffer& commands) const;
  void take(const vk::raii::CommandBuffer& commands, uint32_t slot);

  /// Of the last frame that was recorded, once it has finished.
  Counters counters() const;
  std::vector<Allocation> allocations() const;

 private:
  std::vector<std::string> names_;
  gpu::Buffer counts_;
  std::vector<gpu::Buffer> read_;  ///< by slot
  uint32_t last_slot_ = 0;
};

/// Each receiver's colour: grey where its own texel decided, green where its neighbours, red where recovery did; bright
/// where lit. Waits. `maps` is "parameterization/storage".
Picture decisions_picture(const gpu::Device& device, std::string_view maps, const ReceiverLookup& lookup,
                          bool six_faces);

}  // namespace shadewright::shadow
