// The part of `bench cpvs` that needs a device.
#pragma once

#include "bench.h"

namespace shadewright::app {

/// Figures 8, 10 and 11, and the gain of the order of traversal, at the options' largest resolution.
void cpvs_device_tables(Bench& bench);

}  // namespace shadewright::app
