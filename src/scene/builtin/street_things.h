// What stands about in streets and parks: lamps, benches, bollards, bins, a fountain, cars. Every part is closed; all
// stand on y = 0 and sink a little below it.
#pragma once

#include "scene/builtin/random.h"
#include "scene/builtin/stage.h"

namespace shadewright::builtin {

/// `detail` 1 .. 3 sets how round the round things are. The arm reaches along +X.
Prop street_lamp(Scene& scene, int detail);
/// Seat faces +Z.
Prop bench(Scene& scene, int detail);
Prop bollard(Scene& scene, int detail);
Prop bin(Scene& scene, int detail);
Prop fountain(Scene& scene, int detail);
/// Drives along +X, 4.2 m long; the body takes the dye.
Prop car(Scene& scene, int detail, Random& random);

}  // namespace shadewright::builtin
