#include "compare/study/stage_log.h"

#include <algorithm>

namespace shadewright::compare {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void StageLog::add(std::span<const gpu::StageTime> stages) {
  std::map<std::string, double> frame;
  double total = 0;
  for (const gpu::StageTime& stage : stages) {
    if (std::find(order_.begin(), order_.end(), stage.name) == order_.end()) order_.push_back(stage.name);
    frame[stage.name] += stage.milliseconds;
    total += stage.milliseconds;
  }
  for (const auto& [name, milliseconds] : frame) times_[name].push_back(milliseconds);
  totals_.push_back(total);
}

Timing StageLog::timing() const {
  Timing timing;
  if (totals_.empty()) return timing;
  timing.median = median(totals_);
  timing.min = *std::min_element(totals_.begin(), totals_.end());
  timing.max = *std::max_element(totals_.begin(), totals_.end());
  for (const std::string& name : order_) timing.stages.push_back({name, median(times_.at(name))});
  return timing;
}

}  // namespace shadewright::compare
