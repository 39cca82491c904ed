// How long work tells where it is. The library never prints: it calls this, and the command line draws the bar.
#pragma once

#include <functional>
#include <string_view>

namespace shadewright {

/// Called with the name of the running task and its finished share in [0, 1], from one thread at a time, at most some
/// hundred times a task. May throw to cancel the work; the exception reaches the caller of the work.
using Progress = std::function<void(std::string_view task, double fraction)>;

/// A sink for callers who do not want to know.
inline void no_progress(std::string_view, double) {}

}  // namespace shadewright
