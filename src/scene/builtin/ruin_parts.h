// Pieces of a ruined town, made of open sheets: columns without caps, walls of one side, arches without a back. None of
// them is closed, on purpose.
#pragma once

#include "scene/builtin/random.h"
#include "scene/builtin/stage.h"

namespace shadewright::builtin {

/// All stand on y = 0 and reach 0.5 m below it. `detail` multiplies the resolution of the sheets along each axis.
struct RuinPartSize {
  double detail = 1;
};

/// A fluted column, 6 m when whole; `broken` (0 .. 1) is how much of it is missing at the top.
Prop ruin_column(Scene& scene, RuinPartSize size, double broken, Random& random);
/// A column's drum that has fallen over, axis along X, half sunk.
Prop ruin_drum(Scene& scene, RuinPartSize size, Random& random);
/// A wall along X of `length` metres that crumbles towards its ends, with window holes; seen from both sides it is one
/// sheet thick when `single` is true, else two sheets without a top.
Prop ruin_wall(Scene& scene, RuinPartSize size, double length, double height, bool single, Random& random);
/// A row of `spans` round arches along X, 5 m each: front, back and soffit, no top, worn away at one end.
Prop ruin_arches(Scene& scene, RuinPartSize size, int spans, double height, Random& random);
/// A tomb of four walls with a door and a broken barrel vault, all single-sided.
Prop ruin_tomb(Scene& scene, RuinPartSize size, Random& random);
/// A round temple's drum and half its dome.
Prop ruin_dome(Scene& scene, RuinPartSize size, Random& random);
/// Steps around a platform of 2 half_x by 2 half_z metres: treads and risers only.
Prop ruin_steps(Scene& scene, double half_x, double half_z, int steps);
/// Ivy or grass: loose leaves of two triangles, `count` of them over a patch of `radius` metres.
Prop ruin_weeds(Scene& scene, uint32_t count, double radius, Random& random);
/// A stone without an underside.
Prop ruin_stone(Scene& scene, RuinPartSize size, Random& random);

}  // namespace shadewright::builtin
