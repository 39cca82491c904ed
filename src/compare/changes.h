// What two reports have in common: the same technique in each, and whether their figures may be held against each
// other.
#pragma once

#include <string>
#include <vector>

#include "shadewright/compare/report.h"

namespace shadewright::compare {

/// One technique in two reports; null where a report does not have it.
struct Change {
  const TechniqueResult* before = nullptr;
  const TechniqueResult* after = nullptr;
};

/// Pairs results by canonical spec, in the order of `after`, then what vanished in the order of `before`. A spec that
/// occurs twice is paired in order.
std::vector<Change> pair_results(const Report& before, const Report& after);

/// What else changed between the runs (scene, device, size, view), a sentence each: then differences are not the
/// techniques'.
std::vector<std::string> changed_conditions(const Report& before, const Report& after);

}  // namespace shadewright::compare
