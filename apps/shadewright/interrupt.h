// Ctrl-C during long work: the next progress call throws, and the work unwinds, leaving nothing half-written.
#pragma once

#include <string>

#include "shadewright/progress.h"

namespace shadewright::app {

/// Thrown by an interruptible progress after SIGINT or SIGTERM.
struct Interrupted {
  std::string left = "nothing was written";  ///< what there is of the work
};

/// `progress`, but it throws Interrupted once the program was told to stop. Installs the signal handlers.
Progress interruptible(Progress progress);

}  // namespace shadewright::app
