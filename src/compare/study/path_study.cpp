#include "shadewright/compare/path_study.h"

#include <fmt/format.h>

#include <algorithm>

#include "compare/study/technique_run.h"
#include "shadewright/compare/flicker.h"
#include "shadewright/error.h"

namespace shadewright::compare {
namespace {

/// One technique's way through the frames.
class Course {
 public:
  Course(const StudyView& view, const shadow::Spec& spec, const Progress& progress)
      : technique_(view, spec, progress) {}

  /// Draws the frame and measures it. `timed` frames count for the milliseconds.
  Outcome step(StudyView& view, uint64_t index, bool timed, std::span<const std::string> debug) {
    const auto stages = technique_.draw(view, index);
    StageLog frame;
    frame.add(stages);
    if (timed) log_.add(stages);
    Outcome outcome = technique_.outcome(view, index, debug);
    outcome.result.milliseconds = frame.timing();
    outcome.result.frame_milliseconds = outcome.result.milliseconds.median + view.camera_milliseconds();
    if (timed) frame_milliseconds_.push_back(outcome.result.frame_milliseconds);
    collect(outcome.result);
    return outcome;
  }

  /// Compares with the frame before, once both are measured. `back` is where the points of this frame were then, `on`
  /// where those of the frame before are now; both empty in the first frame.
  void count(const StudyView& view, Outcome& outcome, std::span<const PixelsAround> back,
             std::span<const PixelsAround> on) {
    std::vector<uint8_t> wrong = wrong_pixels(metrics_input(view, outcome.visibility));
    if (!back.empty()) {
      FlickerCount count = count_flicker(back, wrong, wrong_);
      count += count_flicker(on, wrong_, wrong);
      outcome.result.error.flicker = result_.frames.back().flicker = count.fraction();
      flicker_ += count;
    }
    wrong_ = std::move(wrong);
  }

  TechniqueResult finish(bool with_flicker) {
    result_.error = total(errors_);
    if (with_flicker) result_.error.flicker = flicker_.fraction();
    result_.milliseconds = log_.timing();
    result_.frame_milliseconds = median(frame_milliseconds_);
    return std::move(result_);
  }

 private:
  void collect(const TechniqueResult& frame) {
    result_.technique = frame.technique;
    result_.spec = frame.spec;
    errors_.push_back(frame.error);
    result_.frames.push_back({frame.error.wrong, 0, frame.milliseconds.median});
    if (frame.memory_bytes() > result_.memory_bytes()) result_.memory = frame.memory;
    for (const auto& [name, values] : frame.counters) {
      std::vector<double>& largest = result_.counters[name];
      for (size_t k = 0; k < values.size(); ++k) {
        if (k < largest.size())
          largest[k] = std::max(largest[k], values[k]);
        else
          largest.push_back(values[k]);
      }
    }
  }

  TechniqueRun technique_;
  StageLog log_;
  std::vector<ErrorFigures> errors_;
  std::vector<double> frame_milliseconds_;
  std::vector<uint8_t> wrong_;  ///< of the last frame
  FlickerCount flicker_;
  TechniqueResult result_;
};

SeenFrame seen(const StudyView& view) {
  SeenFrame frame{view.moment().time, view.grid(), {}, {}, {}};
  frame.points.assign(view.points().begin(), view.points().end());
  frame.facing.assign(view.facing().begin(), view.facing().end());
  frame.instances = instances_seen(view.tracer(), frame.grid, view.near(), frame.points);
  return frame;
}

bool light_moves(std::span<const Moment> moments) {
  return std::ranges::any_of(moments, [&](const Moment& moment) {
    const Light &a = moment.light, &b = moments.front().light;
    return a.direction != b.direction || a.position != b.position;
  });
}

const std::vector<Moment>& require_frames(const std::vector<Moment>& moments) {
  if (moments.empty()) throw InputError("the frames to compare", "there are none", "ask for at least one");
  return moments;
}

}  // namespace

struct PathStudy::Impl {
  std::string name;
  std::vector<Moment> moments;
  StudyView view;
  std::vector<std::string> notes;

  Impl(const gpu::Device& device, const Scene& scene, std::string path_name, std::vector<Moment> path_moments,
       const StudyOptions& options)
      : name(std::move(path_name)),
        moments(std::move(path_moments)),
        view(device, scene, options, require_frames(moments).front().time) {}
};

PathStudy::PathStudy(const gpu::Device& device, const Scene& scene, std::string name, std::vector<Moment> moments,
                     const StudyOptions& options)
    : impl_(std::make_unique<Impl>(device, scene, std::move(name), std::move(moments), options)) {}

PathStudy::~PathStudy() = default;

void PathStudy::add_notes(std::span<const std::string> notes) {
  impl_->notes.insert(impl_->notes.end(), notes.begin(), notes.end());
}

const StudyOptions& PathStudy::options() const {
  return impl_->view.options();
}

uint32_t PathStudy::frame_count() const {
  return static_cast<uint32_t>(impl_->moments.size());
}

uint32_t PathStudy::pictured_frame() const {
  return frame_count() / 2;
}

std::span<const uint8_t> PathStudy::reference() const {
  return impl_->view.reference();
}

std::vector<glm::vec3> PathStudy::shade(std::span<const float> visibility) const {
  return impl_->view.shade(visibility);
}

Report PathStudy::run(std::span<const shadow::Spec> specs, std::span<const std::string> debug, const Watch& watch,
                      const Progress& progress) {
  StudyView& view = impl_->view;
  const bool with_reference = view.options().reference;
  std::vector<Course> courses;
  for (const shadow::Spec& spec : specs) courses.emplace_back(view, spec, progress);

  Report report;
  std::vector<double> camera_milliseconds, reference_milliseconds;
  StudyView::LitCount lit;
  SeenFrame before;
  for (uint32_t f = 0; f < frame_count(); ++f) {
    progress(fmt::format("frame {} of {}", f + 1, frame_count()), static_cast<double>(f) / frame_count());
    const bool timed = f > 0 || frame_count() == 1;
    view.show(impl_->moments[f], 0);
    view.trace(false, no_progress);
    std::vector<PixelsAround> back, on;
    if (with_reference) {
      SeenFrame now = seen(view);
      if (f > 0) {
        back = reproject(view.scene(), now, before);
        on = reproject(view.scene(), before, now);
      }
      before = std::move(now);
    }
    std::vector<Outcome> outcomes;
    for (Course& course : courses) {
      outcomes.push_back(course.step(view, f, timed, debug));
      if (with_reference) course.count(view, outcomes.back(), back, on);
    }
    if (f == pictured_frame()) report = view.describe();
    if (timed) {
      camera_milliseconds.push_back(view.camera_milliseconds());
      reference_milliseconds.push_back(view.reference_milliseconds());
    }
    const StudyView::LitCount frame_lit = view.count_lit();
    lit.compared += frame_lit.compared;
    lit.lit += frame_lit.lit;
    if (watch) watch(f, outcomes);
  }

  report.path = ReportPath{impl_->name,
                           frame_count(),
                           impl_->moments.front().time,
                           impl_->moments.back().time,
                           pictured_frame(),
                           light_moves(impl_->moments)};
  report.camera_pass_milliseconds = median(camera_milliseconds);
  report.reference_milliseconds = median(reference_milliseconds);
  if (lit.compared > 0)
    report.reference_lit_fraction = static_cast<double>(lit.lit) / static_cast<double>(lit.compared);
  report.notes = impl_->notes;
  if (with_reference && lit.compared == 0) report.notes.push_back(nothing_compared);
  for (Course& course : courses) report.results.push_back(course.finish(with_reference && frame_count() > 1));
  progress("frames", 1);
  return report;
}

}  // namespace shadewright::compare
