// Bounds of the surface points that the camera sees, reduced on the device and read back.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "shadow/parameterization/parameterization.h"
#include "shadow/parameterization/uniform/fit.h"

namespace shadewright::shadow {

/// A range of view depths (the camera's clip w).
struct DepthRange {
  double nearest = 0, farthest = std::numeric_limits<double>::infinity();
};

class VisibleBounds {
 public:
  explicit VisibleBounds(const gpu::Device& device);

  /// For each of at most 8 light frames the bounds, as `receiver_bounds` has them, of the surface points inside its
  /// window whose view depths are in the range at the same place of `depths` (empty: all). Records a stage, submits it
  /// and waits.
  std::vector<Box> measure(const Frame& frame, gpu::Recorder& recorder, std::span<const LightFrame> lights,
                           std::span<const DepthRange> depths = {});

  std::vector<Allocation> allocations() const {
    return {camera_.allocation(), sets_.allocation(), bounds_.allocation()};
  }

 private:
  gpu::ComputePass pass_;
  vk::raii::Sampler sampler_;
  gpu::Buffer camera_, sets_, bounds_;
};

}  // namespace shadewright::shadow
