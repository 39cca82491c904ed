// Milliseconds of named stages over many frames.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "shadewright/compare/report.h"
#include "shadewright/gpu/recorder.h"

namespace shadewright::compare {

/// The middle value; 0 for none.
double median(std::vector<double> values);

class StageLog {
 public:
  /// Adds a frame: stages of one name are summed.
  void add(std::span<const gpu::StageTime> stages);
  Timing timing() const;

 private:
  std::vector<std::string> order_;
  std::map<std::string, std::vector<double>> times_;
  std::vector<double> totals_;
};

}  // namespace shadewright::compare
