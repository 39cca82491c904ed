// Putting meshes together and moving them: what every shape and scene here needs.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "shadewright/scene/scene.h"

namespace shadewright::builtin {

/// Adds a copy of `part`, moved by `to_from`, to `mesh`. A mirroring transform turns the triangles so that outside
/// stays outside.
void append(Mesh& mesh, const Mesh& part, const glm::dmat4& to_from = glm::dmat4(1.0));

/// `mesh` moved by `to_from`; a mirroring transform keeps outside outside.
Mesh transformed(Mesh mesh, const glm::dmat4& to_from);

/// Affine maps, right to left as matrices multiply. Angles in radians, about the axis of the name, right-handed.
glm::dmat4 moved(const glm::dvec3& offset);
glm::dmat4 scaled(const glm::dvec3& factors);
glm::dmat4 turned_x(double angle);
glm::dmat4 turned_y(double angle);
glm::dmat4 turned_z(double angle);

/// The rigid map whose +Y axis runs along `axis` (any length) and whose origin is `origin`: stands upright shapes on
/// end.
glm::dmat4 along(const glm::dvec3& origin, const glm::dvec3& axis);

}  // namespace shadewright::builtin
