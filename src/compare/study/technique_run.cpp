#include "compare/study/technique_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/difference.h"
#include "compare/visibility_floats.h"

namespace shadewright::compare {
namespace {

/// What a perfect map of this resolution would answer: free sight from the rays' origins to the light.
std::vector<uint8_t> oracle_visibility(const StudyView& view, const shadow::OracleRays& oracle) {
  const Light& light = view.moment().light;
  std::vector<Segment> segments(oracle.origins.size());
  for (size_t i = 0; i < segments.size(); ++i) {
    const glm::vec3& origin = oracle.origins[i];
    if (!view.facing()[i] || !std::isfinite(origin.x)) continue;
    if (light.kind == LightKind::directional)
      segments[i] = {origin, std::numeric_limits<float>::infinity(), -glm::vec3(light.direction), 1};
    else
      segments[i] = {origin, 1.0f, glm::vec3(light.position) - origin, 1};
  }
  return view.tracer().unoccluded(segments, view.options().width);
}

}  // namespace

MetricsInput metrics_input(const StudyView& view, std::span<const float> visibility) {
  MetricsInput input;
  input.width = view.options().width;
  input.height = view.options().height;
  input.points = view.points();
  input.eye = glm::vec3(view.moment().camera.eye);
  input.facing = view.facing();
  input.visibility = visibility;
  input.reference = view.reference();
  input.reference_filtered = view.filtered();
  return input;
}

TechniqueRun::TechniqueRun(const StudyView& view, const shadow::Spec& spec, const Progress& progress) : spec_(spec) {
  const StudyOptions& options = view.options();
  if (spec.parameterization != "ray")
    technique_ =
        shadow::make_technique(view.device(), spec, {options.width, options.height, 1, true, &view.scene(), progress});
}

std::vector<gpu::StageTime> TechniqueRun::draw(StudyView& view, uint64_t index) {
  if (!technique_) return {{"shadow rays", view.reference_milliseconds()}};
  shadow::Frame frame = view.frame();
  frame.index = index;
  gpu::Recorder recorder(view.device());
  technique_->prepare(frame, recorder);
  technique_->record(frame, recorder);
  return recorder.finish();
}

Outcome TechniqueRun::outcome(StudyView& view, uint64_t index, std::span<const std::string> debug) {
  Outcome outcome;
  outcome.result.technique = spec_.text;
  outcome.result.spec = spec_.canonical();
  outcome.debug.resize(debug.size());
  std::optional<shadow::OracleRays> oracle;
  if (technique_) {
    outcome.result.memory = technique_->allocations();
    outcome.result.counters = technique_->counters();
    outcome.visibility = visibility_floats(gpu::read_back(view.device(), technique_->visibility(), 1));
    shadow::Frame frame = view.frame();
    frame.index = index;
    if (view.options().reference) oracle = technique_->oracle_rays(frame);
    for (size_t i = 0; i < debug.size(); ++i)
      if (std::ranges::count(technique_->debug_names(), debug[i]) > 0)
        outcome.debug[i] = technique_->debug_picture(debug[i]);
  } else {
    outcome.visibility.assign(view.reference().begin(), view.reference().end());
  }
  if (!view.options().reference) return outcome;
  MetricsInput input = metrics_input(view, outcome.visibility);
  std::vector<uint8_t> perfect;
  if (oracle) {
    if (!oracle->origins.empty()) perfect = oracle_visibility(view, *oracle);
    input.oracle = perfect;
    input.texel_u = oracle->texel_u;
    input.texel_v = oracle->texel_v;
  }
  outcome.result.error = measure_error(input, view.tracer(), view.moment().light);
  outcome.difference = difference_picture(input);
  return outcome;
}

}  // namespace shadewright::compare
