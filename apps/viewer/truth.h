// The ray-traced answer to what the camera pass drew, as an image beside the techniques' answers.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shadewright/compare/report.h"
#include "shadewright/gpu/resources.h"
#include "shadewright/raytrace/tracer.h"
#include "shadewright/render/camera_pass.h"
#include "shadewright/scene/moments.h"

namespace shadewright::viewer {

class Truth {
 public:
  /// Prepares `scene`, which outlives this, for rays; takes seconds where it is large.
  Truth(const gpu::Device& device, const Scene& scene, uint32_t width, uint32_t height);

  /// Traces what `camera_pass` has drawn through `view` at the moment.
  void trace(const Moment& moment, render::CameraPass& camera_pass, const render::CameraView& view);

  /// R8, 1 = lit, in shader-read layout.
  gpu::Image& visibility() { return visibility_; }
  /// Of the rays alone.
  double milliseconds() const { return milliseconds_; }
  /// The figures of an answer to the same points, a byte a pixel.
  compare::ErrorFigures error(std::span<const std::byte> answer) const;

 private:
  const gpu::Device& device_;
  const Scene& scene_;
  uint32_t width_, height_;
  Tracer tracer_;
  gpu::Image visibility_;
  Moment moment_;
  std::vector<SurfacePoint> points_;
  std::vector<uint8_t> lit_;
  double milliseconds_ = 0;
};

}  // namespace shadewright::viewer
