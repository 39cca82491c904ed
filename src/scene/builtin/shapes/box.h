// Boxes: the plain one, one with cut edges, and a tapered one. Closed, outward oriented.
#pragma once

#include <glm/glm.hpp>

#include "shadewright/scene/scene.h"

namespace shadewright::builtin {

/// 12 triangles.
Mesh box(const glm::dvec3& min, const glm::dvec3& max);
/// A box whose four upper edges are cut by `bevel` metres: 20 triangles.
Mesh slab(const glm::dvec3& min, const glm::dvec3& max, double bevel);
/// A frustum with rectangular floor and roof: from `bottom` half sizes (x, z) at y = 0 to `top` at y = height.
Mesh tapered_box(const glm::dvec2& bottom_half, const glm::dvec2& top_half, double height);
/// A box from `a` to `b` (the centres of its ends) of width `width` (horizontal, across) and height `height`: beams,
/// planks.
Mesh beam(const glm::dvec3& a, const glm::dvec3& b, double width, double height);

}  // namespace shadewright::builtin
