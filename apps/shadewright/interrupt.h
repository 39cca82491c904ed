// Ctrl-C during long work: the next progress call throws, and the work unwinds, leaving nothing half-written.
#pragma once

#include "shadewright/progress.h"

namespace shadewright::app {

/// Thrown by an interruptible progress after SIGINT or SIGTERM.
struct Interrupted {};

/// `progress`, but it throws Interrupted once the program was told to stop. Installs the signal handlers.
Progress interruptible(Progress progress);

}  // namespace shadewright::app
