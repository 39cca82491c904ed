// Which receivers anything may shadow: the rest is lit without a map. Ground that nothing stands on, or a whole scene's
// ground as a caster on what stands above it, costs no texels then.
#pragma once

#include "shadow/parameterization/perspective/receivers.h"
#include "shadow/parameterization/uniform/fit.h"

namespace shadewright::shadow {

/// Leaves only boxes and samples that casters inside `casters` (world bounds) may shadow, and tells samples how much of
/// the casters' edges is expected around them; the hull stays as it is. True if boxes were left out. Never leaves out a
/// receiver in a shadow, but for one of a caster that is as near to it as floats tell.
bool keep_shadowable(Receivers& receivers, const Light& light, const LightFrame& frame, std::span<const Box> casters);

}  // namespace shadewright::shadow
