// Progress on stderr: a bar with the time left on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <string>

#include "shadewright/progress.h"

namespace shadewright::app {

class ProgressBar {
 public:
  /// A quiet bar shows nothing.
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// To hand to the library. The bar must outlive it.
  Progress callback();
  /// Ends the running line, so that something else can be printed.
  void clear();

 private:
  void show(std::string_view task, double fraction);

  bool quiet_, terminal_;
  std::string task_;
  double shown_ = -1;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace shadewright::app
