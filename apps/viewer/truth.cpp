#include "truth.h"

#include <chrono>

#include "compare/visibility_floats.h"
#include "shadewright/compare/metrics.h"

namespace shadewright::viewer {

Truth::Truth(const gpu::Device& device, const Scene& scene, uint32_t width, uint32_t height)
    : device_(device), scene_(scene), width_(width), height_(height), tracer_(scene) {
  using Usage = vk::ImageUsageFlagBits;
  visibility_ =
      gpu::Image(device, {"truth", vk::Format::eR8Unorm, width, height, 1, Usage::eSampled | Usage::eTransferDst});
}

void Truth::trace(const Moment& moment, render::CameraPass& camera_pass, const render::CameraView& view) {
  moment_ = moment;
  tracer_.update(scene_, moment.time);
  points_ = camera_pass.surface_points(view);
  const auto start = std::chrono::steady_clock::now();
  lit_ = tracer_.visible(points_, glm::vec3(moment.camera.eye), moment.light, width_);
  milliseconds_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  std::vector<std::byte> bytes(lit_.size());
  // Pixels without geometry are lit, as in every technique's image.
  for (size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = lit_[i] != 0 || !points_[i].valid() ? std::byte{255} : std::byte{0};
  gpu::upload(device_, visibility_, bytes);
}

compare::ErrorFigures Truth::error(std::span<const std::byte> answer) const {
  const std::vector<float> visibility = compare::visibility_floats(answer);
  const std::vector<uint8_t> facing = compare::facing_light(points_, moment_.light);
  compare::MetricsInput input;
  input.width = width_;
  input.height = height_;
  input.points = points_;
  input.eye = glm::vec3(moment_.camera.eye);
  input.facing = facing;
  input.visibility = visibility;
  input.reference = lit_;
  return compare::measure_error(input, tracer_, moment_.light);
}

}  // namespace shadewright::viewer
