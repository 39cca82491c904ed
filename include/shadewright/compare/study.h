// One view of one scene under one light, with its truth; techniques are held against it one after the other.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "shadewright/compare/report.h"
#include "shadewright/gpu/device.h"
#include "shadewright/progress.h"
#include "shadewright/render/camera_pass.h"
#include "shadewright/render/image.h"
#include "shadewright/scene/scene.h"
#include "shadewright/shadow/spec.h"
#include "shadewright/shadow/technique.h"

namespace shadewright::compare {

struct StudyOptions {
  uint32_t width = 1920, height = 1080;  ///< pixels
  uint32_t repeat = 10;                  ///< timed frames after warm-up
  uint32_t reference_samples = 16;  ///< of the filtered reference, in a pixel's footprint; 0 = no filtered reference
  bool reference = true;            ///< false: no truth, `run` measures no error
};

/// What a technique showed.
struct Outcome {
  TechniqueResult result;         ///< picture names empty
  std::vector<float> visibility;  ///< 0..1, row by row
  Picture difference;             ///< false shadow red, false lit blue, else transparent; empty without reference
  std::vector<Picture> debug;     ///< one a name asked for; empty where the technique has none of that name
};

class Study {
 public:
  /// Uploads the scene, draws the camera pass and traces the reference. Everything referred to stays alive as long as
  /// the study; `progress` is also told what `run` bakes.
  Study(const gpu::Device& device, const Scene& scene, const Camera& camera, const Light& light,
        const StudyOptions& options, const Progress& progress = no_progress);
  ~Study();

  /// Scene, device, image, camera, light, reference and camera pass, without results.
  const Report& report() const;
  /// Remarks for the report: the camera that was chosen, warnings of the loader.
  void add_notes(std::span<const std::string> notes);
  /// Draws, times and measures one technique. `debug` names debug images of it to take along (see
  /// Technique::debug_names).
  Outcome run(const shadow::Spec& spec, std::span<const std::string> debug = {});

  std::span<const SurfacePoint> points() const;
  std::span<const uint8_t> reference() const;  ///< 0 or 1; empty without reference
  /// The scene lit with `visibility`, linear.
  std::vector<glm::vec3> shade(std::span<const float> visibility) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Runs every spec, writes pictures, report.json, report.csv and index.html into `folder` (see
/// `write_folder`: whole or not at all), and returns the report. `before` adds what changed against an earlier one.
/// `debug` names debug images, of which each technique's own are written too.
Report compare_techniques(Study& study, std::span<const shadow::Spec> specs, const std::filesystem::path& folder,
                          const Report* before = nullptr, const Progress& progress = no_progress,
                          std::span<const std::string> debug = {});

}  // namespace shadewright::compare
