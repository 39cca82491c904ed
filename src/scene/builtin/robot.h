// A robot's bones for the walk of figure.h: armour, pistons and joints, closed parts in each bone's own frame.
#pragma once

#include <array>

#include "scene/builtin/figure.h"

namespace shadewright::builtin {

/// One prop per bone, indexed by `Bone`. The armour takes the dye.
std::array<Prop, bone_count> robot_bones(Scene& scene);

}  // namespace shadewright::builtin
