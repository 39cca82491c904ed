#include "interrupt.h"

#include <csignal>
#include <utility>

namespace shadewright::app {

namespace {

volatile std::sig_atomic_t stop_asked = 0;

}  // namespace

Progress interruptible(Progress progress) {
  const auto ask = [](int) { stop_asked = 1; };
  std::signal(SIGINT, ask);
  std::signal(SIGTERM, ask);
  return [progress = std::move(progress)](std::string_view task, double fraction) {
    if (stop_asked) throw Interrupted{};
    progress(task, fraction);
  };
}

}  // namespace shadewright::app
