// What closes a house at the top: gable, hip or flat roof, chimneys, dormers, tanks. Every part is closed.
#pragma once

#include "scene/builtin/house.h"

namespace shadewright::builtin {

/// Adds the roof of a house whose topmost storey ends at `eaves` metres.
void add_roof(Scene& scene, Prop& prop, const HouseShape& shape, double eaves, Random& random);

}  // namespace shadewright::builtin
