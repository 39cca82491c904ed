// The matrices between world and clip space. Clip space is Vulkan's: x right, y down, depth 0..1.
#pragma once

#include <glm/glm.hpp>

#include "shadewright/geometry/box.h"

namespace shadewright {

/// View space from world: right-handed, looking along -Z, +Y up. `forward` need not be unit length; `up` may be
/// parallel to it (another one is then chosen).
glm::dmat4 look_along(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up);

/// Clip from view for a camera: reversed depth (1 at `near`, 0 at infinity). `fov_y` in radians, `near` in metres.
glm::dmat4 perspective_reversed_infinite(double fov_y, double aspect, double near);

/// Clip from view for a light: depth grows from 0 at z = -near to 1 at z = -far. `window` bounds x/-z and y/-z
/// (tangents), min to max, y up.
glm::dmat4 perspective_window(const glm::dvec2& window_min, const glm::dvec2& window_max, double near, double far);

/// Clip from view for a light: x, y of `box` fill the clip square (y up in view, down in clip), depth is 0 at z =
/// box.max.z (nearest, as the view looks along -Z) and 1 at z = box.min.z. The box has a positive size on every axis.
glm::dmat4 orthographic(const Box& box);

/// An orthonormal pair perpendicular to the unit vector `axis`, continuous except at one pole (-Z); cross(u, v) = axis.
void perpendicular_axes(const glm::dvec3& axis, glm::dvec3& u, glm::dvec3& v);

}  // namespace shadewright
