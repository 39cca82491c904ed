// How a person moves a camera. What it looks at moves along, so that it can be circled.
#pragma once

#include "shadewright/scene/scene.h"

namespace shadewright::viewer {

/// `camera` turned about its eye: `yaw` to the right and `pitch` upwards, radians. Afterwards it stands upright (+Y)
/// and looks neither straight up nor down.
Camera turned(const Camera& camera, double yaw, double pitch);

/// The same turn about what it looks at: the eye moves, to the left for a turn to the right.
Camera circled(const Camera& camera, double yaw, double pitch);

/// `camera` moved to its right (level), up (the world's +Y) and forward, metres.
Camera moved(const Camera& camera, const glm::dvec3& right_up_forward);

/// The eye at `factor` times its distance from what it looks at, which stays from `least` to `most` metres.
Camera approached(const Camera& camera, double factor, double least, double most);

}  // namespace shadewright::viewer
