// What all techniques of a study share in a frame: the scene on the device, the camera pass, and the truth.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "shadewright/compare/study.h"
#include "shadewright/raytrace/tracer.h"
#include "shadewright/scene/moments.h"
#include "shadewright/shadow/technique.h"

namespace shadewright::compare {

/// The report's note where no pixel was compared.
inline const std::string nothing_compared = "no pixel faces the light: nothing was compared";

class StudyView {
 public:
  /// Uploads the scene as it is at `time`; nothing is seen before `show`.
  StudyView(const gpu::Device& device, const Scene& scene, const StudyOptions& options, double time);

  /// Moves the scene to the moment and draws the camera pass: once, and `repeat` times more to be timed.
  void show(const Moment& moment, uint32_t repeat);
  /// Traces the truth of what is shown: once, and once more to be timed if `repeat`. Part of the work is skipped if the
  /// options want no reference.
  void trace(bool repeat, const Progress& progress);

  const gpu::Device& device() const { return device_; }
  const Scene& scene() const { return scene_; }
  const StudyOptions& options() const { return options_; }
  const Moment& moment() const { return moment_; }
  double near() const { return near_; }
  std::span<const SurfacePoint> points() const { return points_; }
  std::span<const uint8_t> facing() const { return facing_; }
  std::span<const uint8_t> reference() const { return reference_; }  ///< empty without one
  std::span<const float> filtered() const { return filtered_; }      ///< empty without one
  const Tracer& tracer() const { return *tracer_; }                  ///< at the moment; only after `trace`
  PixelGrid grid() const { return {options_.width, options_.height, moment_.camera}; }
  double camera_milliseconds() const { return camera_milliseconds_; }
  double reference_milliseconds() const { return reference_milliseconds_; }

  /// The techniques' input; `index` is left at 0.
  shadow::Frame frame();
  /// The scene lit with `visibility`, linear.
  std::vector<glm::vec3> shade(std::span<const float> visibility);
  /// Compared pixels, and those of them that are lit in truth, of this moment.
  struct LitCount {
    uint64_t compared = 0, lit = 0;
  };
  LitCount count_lit() const;
  /// A report about this view, without results; places are in the scene file's coordinates.
  Report describe() const;

 private:
  const gpu::Device& device_;
  const Scene& scene_;
  StudyOptions options_;
  render::SceneGpu scene_gpu_;
  render::CameraPass camera_pass_;
  std::unique_ptr<render::CameraPass> colored_;  ///< made when a picture is first wanted
  std::unique_ptr<Tracer> tracer_;

  Moment moment_;
  double near_ = 0;
  render::CameraView view_;
  std::vector<SurfacePoint> points_;
  std::vector<uint8_t> facing_, reference_;
  std::vector<uint8_t> albedo_;  ///< of this moment; empty until it is wanted
  std::vector<float> filtered_;
  double camera_milliseconds_ = 0, reference_milliseconds_ = 0;
};

}  // namespace shadewright::compare
