// Techniques held against ray tracing over many frames: a camera path, moving things, a light that turns.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shadewright/compare/study.h"
#include "shadewright/scene/moments.h"

namespace shadewright::compare {

class PathStudy {
 public:
  /// What `run` shows its caller after each frame: an outcome a spec, in their order, of this frame alone.
  using Watch = std::function<void(uint32_t frame, std::span<const Outcome> outcomes)>;

  /// Uploads the scene. `moments` are the frames, at least one (else InputError); `name` is the camera path's, for the
  /// report. `options.repeat` does not matter: frames are drawn once. Everything referred to stays alive as long as
  /// the study.
  PathStudy(const gpu::Device& device, const Scene& scene, std::string name, std::vector<Moment> moments,
            const StudyOptions& options);
  ~PathStudy();

  /// Remarks for the report.
  void add_notes(std::span<const std::string> notes);
  const StudyOptions& options() const;
  uint32_t frame_count() const;
  /// The frame that the report's camera, light and pictures are of: the middle one, when techniques that keep something
  /// from frame to frame have come to rest.
  uint32_t pictured_frame() const;

  /// Goes through the frames, each seen and traced once, with one technique object a spec that lives through all of
  /// them (so that caches and histories work). In the report: errors are `total`, with flicker if there are two frames
  /// and a reference; milliseconds are over the frames without the first, which compiles shaders; counters are
  /// the frames' largest; memory is of the frame that had most. Picture names are left empty. `debug` names debug
  /// images to take along in every frame; `watch` may call what stands below.
  Report run(std::span<const shadow::Spec> specs, std::span<const std::string> debug = {}, const Watch& watch = {},
             const Progress& progress = no_progress);

  std::span<const uint8_t> reference() const;  ///< of the frame under way, 0 or 1; empty without reference
  /// The frame under way, lit with `visibility`, linear.
  std::vector<glm::vec3> shade(std::span<const float> visibility) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// As compare_techniques, over a path: pictures are of the study's pictured frame. `every_frame` also writes the
/// picture of each frame, TECHNIQUE-frames/0000.png and so on, and the truth's as reference-frames.
Report compare_along_path(PathStudy& study, std::span<const shadow::Spec> specs, const std::filesystem::path& folder,
                          bool every_frame, const Report* before = nullptr, const Progress& progress = no_progress,
                          std::span<const std::string> debug = {});

}  // namespace shadewright::compare
