// Sequences of frames: where moving things are, who looks and what shines in each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright {

/// What one frame shows of a scene.
struct Moment {
  double time = 0;  ///< seconds, of the scene's motions
  Camera camera;
  Light light;
};

/// `count` moments evenly from the path's first key to its last, both included, with the scene's motions at the same
/// seconds. InputError for a path without keys.
std::vector<Moment> moments_along(const CameraPath& path, const Light& light, uint32_t count);

/// `count` moments evenly over the scene's motions (first key to last), both included, seen by a camera that keeps
/// still; all at 0 seconds in a scene without motions.
std::vector<Moment> moments_of_motions(const Scene& scene, const Camera& camera, const Light& light, uint32_t count);

/// Azimuth and elevation towards a directional light, degrees: what `sun` takes.
glm::dvec2 sun_angles(const Light& light);

/// Turns the sun over `moments`: azimuth and elevation (degrees) change evenly, as the numbers say, from `from` in the
/// first to `to` in the last.
void turn_sun(std::span<Moment> moments, const glm::dvec2& from, const glm::dvec2& to);

}  // namespace shadewright
