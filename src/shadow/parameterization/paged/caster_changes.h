// What has changed since the last frame: the light, all of the scene, or the casters in some boxes (those that moved:
// where they were and where they are).
#pragma once

#include <span>
#include <vector>

#include "shadewright/shadow/technique.h"
#include "shadow/known_scene.h"
#include "shadow/parameterization/paged/shared.h"

namespace shadewright::shadow {

class CasterChanges {
 public:
  CasterChanges(const gpu::Device& device, uint32_t frames_in_flight) : device_(device), buffers_(frames_in_flight) {}

  /// Compares `frame` with the last one that was given.
  void find(const Frame& frame);
  /// True where nothing of the last frame holds: the first frame, another light or scene.
  bool all() const { return all_; }
  bool any() const { return all_ || !boxes_.empty(); }
  /// World bounds of the casters that moved; none if all() has changed.
  std::span<const shared::ChangedBox> boxes() const { return boxes_; }
  /// Those boxes on the device, for the frames of `slot`.
  const gpu::Buffer& buffer(uint32_t slot) const { return buffers_[slot]; }
  std::vector<Allocation> allocations() const;

 private:
  const gpu::Device& device_;
  KnownScene scene_;
  Light light_;
  render::InstanceFilter casters_ = render::InstanceFilter::all;
  uint64_t updates_ = 0;
  bool known_ = false;
  bool all_ = true;
  std::vector<shared::ChangedBox> boxes_;
  std::vector<gpu::Buffer> buffers_;  ///< by slot, host-written
};

}  // namespace shadewright::shadow
