// One technique object, drawn frame after frame and held against the truth of each.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compare/study/stage_log.h"
#include "compare/study/study_view.h"
#include "shadewright/compare/metrics.h"

namespace shadewright::compare {

class TechniqueRun {
 public:
  /// Makes the technique, which bakes with `progress`; none for `ray`, whose answer is the reference itself.
  TechniqueRun(const StudyView& view, const shadow::Spec& spec, const Progress& progress);

  /// Draws the technique into what `view` shows, as frame `index`, and returns what each stage took.
  std::vector<gpu::StageTime> draw(StudyView& view, uint64_t index);
  /// What the technique showed in the frame that was drawn last, with its error; times and picture names are left
  /// empty.
  Outcome outcome(StudyView& view, uint64_t index, std::span<const std::string> debug);

 private:
  shadow::Spec spec_;
  std::unique_ptr<shadow::Technique> technique_;
};

/// Everything that is compared of a visibility image over `view`, without an oracle. The spans live as long as both.
MetricsInput metrics_input(const StudyView& view, std::span<const float> visibility);

}  // namespace shadewright::compare
