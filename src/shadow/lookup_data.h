// What every look-up is told of the frame: the light and the eye.
#pragma once

#include "shadewright/shadow/technique.h"
#include "shadow/shared.h"

namespace shadewright::shadow {

/// True if nothing of what a shadow depends on differs.
bool same_light(const Light& a, const Light& b);

/// The members that follow from the frame; the map's are left as they are.
shared::LookupData lookup_data(const Frame& frame);

}  // namespace shadewright::shadow
