// Plants of many kinds, each from its own random numbers: what an ecosystem is sown with. Leaves are sheets of two
// triangles, so plants are not closed.
#pragma once

#include "scene/builtin/random.h"
#include "scene/builtin/stage.h"

namespace shadewright::builtin {

/// Each stands on y = 0, true to size; the foliage takes the dye.
Prop grass_tuft(Scene& scene, Random& random);
Prop flower(Scene& scene, Random& random);
Prop fern(Scene& scene, Random& random);
Prop shrub(Scene& scene, Random& random);
Prop mushroom(Scene& scene, Random& random);
/// A cow, 2.2 m long, facing +X: a large closed body. The hide takes the dye.
Prop cow(Scene& scene, Random& random);

}  // namespace shadewright::builtin
