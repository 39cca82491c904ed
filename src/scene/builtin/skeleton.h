// A human skeleton for the walk of figure.h: ribs, vertebrae, skull and long bones, closed parts in each bone's own
// frame.
#pragma once

#include <array>

#include "scene/builtin/figure.h"

namespace shadewright::builtin {

/// One prop per bone, indexed by `Bone`. All take the dye.
std::array<Prop, bone_count> skeleton_bones(Scene& scene);

}  // namespace shadewright::builtin
