// Town houses with real openings: walls pierced by windows before a dark core, sills, roofs, chimneys, balconies,
// steps. Every part is closed.
#pragma once

#include "scene/builtin/random.h"
#include "scene/builtin/stage.h"

namespace shadewright::builtin {

enum class Roof { gable, hip, flat };

struct HouseShape {
  double width = 9, depth = 10;  ///< metres; the front faces +Z and lies at z = depth / 2
  int floors = 3;
  Roof roof = Roof::gable;
  int detail =
      1;  ///< 1: openings, sills, chimneys, a balcony; 2: mullions, shutters, gutters, dormers; 3: tiles, cornices
};

/// Stands on y = 0 and reaches 0.4 m below it. The walls take the dye.
Prop house(Scene& scene, const HouseShape& shape, Random& random);

}  // namespace shadewright::builtin
