// What a parameterization answers on the CPU; its GLSL module answers the same on the device (architecture, section 1).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "shadewright/shadow/technique.h"

namespace shadewright::shadow {

/// What a combination may rely on.
struct Traits {
  bool projective = true;   ///< straight edges stay straight in the map
  bool contiguous = true;   ///< neighbouring texels are neighbours in the world
  bool layered = false;     ///< more than one view at once
  bool gpu_driven = false;  ///< views are a buffer on the device
  bool needs_readback = false;
};

class Parameterization {
 public:
  virtual ~Parameterization() = default;
  virtual Traits traits() const = 0;
  /// The most views a frame can have.
  virtual uint32_t max_views() const = 0;
  /// Finds the frame's views. May submit and wait if it says so in its traits.
  virtual void prepare(const Frame& frame, gpu::Recorder& recorder) = 0;
  virtual std::span<const MapView> views() const = 0;
  virtual Counters counters() const = 0;
  virtual std::vector<Allocation> allocations() const { return {}; }
};

}  // namespace shadewright::shadow
