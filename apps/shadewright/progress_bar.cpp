#include "progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace shadewright::app {

ProgressBar::ProgressBar(bool quiet)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1), start_(std::chrono::steady_clock::now()) {}

ProgressBar::~ProgressBar() {
  clear();
}

Progress ProgressBar::callback() {
  return [this](std::string_view task, double fraction) { show(task, fraction); };
}

void ProgressBar::clear() {
  if (!quiet_ && terminal_ && shown_ >= 0) fmt::print(stderr, "\r\033[K");
  shown_ = -1;
}

void ProgressBar::show(std::string_view task, double fraction) {
  if (quiet_) return;
  if (fraction < shown_) start_ = std::chrono::steady_clock::now();  // another piece of work has begun
  if (!terminal_) {
    if (task != task_) fmt::print(stderr, "{}\n", task);
    task_ = task;
    shown_ = fraction;
    return;
  }
  if (task == task_ && fraction - shown_ < 0.002 && fraction < 1) return;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const std::string left =
      fraction > 0.02 && elapsed > 1 ? fmt::format("  {:.0f} s left", elapsed * (1 - fraction) / fraction) : "";
  constexpr int width = 30;
  const int filled = static_cast<int>(fraction * width);
  fmt::print(stderr, "\r\033[K[{:#<{}}{:.<{}}] {:3.0f} % {}{}", "", filled, "", width - filled, 100 * fraction, task,
             left);
  std::fflush(stderr);
  task_ = task;
  shown_ = fraction;
}

}  // namespace shadewright::app
