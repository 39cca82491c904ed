#include "shadewright/compare/study.h"

#include "compare/study/technique_run.h"

namespace shadewright::compare {

struct Study::Impl {
  StudyView view;
  Report report;
  Progress progress;

  Impl(const gpu::Device& device, const Scene& scene, const StudyOptions& options, const Progress& study_progress)
      : view(device, scene, options, 0), progress(study_progress) {}
};

Study::Study(const gpu::Device& device, const Scene& scene, const Camera& camera, const Light& light,
             const StudyOptions& options, const Progress& progress)
    : impl_(std::make_unique<Impl>(device, scene, options, progress)) {
  progress("camera pass", 0);
  impl_->view.show({0, camera, light}, options.repeat);
  impl_->view.trace(true, progress);
  impl_->report = impl_->view.describe();
  if (options.reference && impl_->view.count_lit().compared == 0) impl_->report.notes.push_back(nothing_compared);
  progress("reference", 1);
}

Study::~Study() = default;

const Report& Study::report() const {
  return impl_->report;
}
void Study::add_notes(std::span<const std::string> notes) {
  impl_->report.notes.insert(impl_->report.notes.end(), notes.begin(), notes.end());
}
std::span<const SurfacePoint> Study::points() const {
  return impl_->view.points();
}
std::span<const uint8_t> Study::reference() const {
  return impl_->view.reference();
}

Outcome Study::run(const shadow::Spec& spec, std::span<const std::string> debug) {
  StudyView& view = impl_->view;
  TechniqueRun technique(view, spec, impl_->progress);
  const uint32_t repeat = view.options().repeat;
  StageLog log;
  for (uint32_t i = 0; i <= repeat; ++i) {
    const auto stages = technique.draw(view, 0);
    if (i > 0 || repeat == 0) log.add(stages);  // the first frame compiles shaders
  }
  Outcome outcome = technique.outcome(view, 0, debug);
  outcome.result.milliseconds = log.timing();
  outcome.result.frame_milliseconds = outcome.result.milliseconds.median + view.camera_milliseconds();
  return outcome;
}

std::vector<glm::vec3> Study::shade(std::span<const float> visibility) const {
  return impl_->view.shade(visibility);
}

}  // namespace shadewright::compare
