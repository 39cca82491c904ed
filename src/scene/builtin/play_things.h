// What stands on a playground: thin bars, chains and ropes. Every part is closed; everything stands on y = 0.
#pragma once

#include "scene/builtin/stage.h"

namespace shadewright::builtin {

/// Two seats on chains of single links from a frame 5 m wide along X.
Prop swings(Scene& scene);
/// Bars crossing at 0.5 m: `nx` by `nz` cells, `ny` high.
Prop climbing_cube(Scene& scene, int nx, int ny, int nz);
/// Half a geodesic ball of bars, `radius` metres.
Prop climbing_dome(Scene& scene, double radius);
/// A mast with a net of ropes around it.
Prop rope_pyramid(Scene& scene);
/// A ladder, a platform with railings and a chute along +X.
Prop slide(Scene& scene);
Prop seesaw(Scene& scene);
Prop roundabout(Scene& scene);
/// Upright bars between two rails, `length` metres along X.
Prop railing(Scene& scene, double length);

}  // namespace shadewright::builtin
