#include "scene/builtin/shapes/mesh_edit.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

namespace shadewright::builtin {

void append(Mesh& mesh, const Mesh& part, const glm::dmat4& to_from) {
  const uint32_t base = static_cast<uint32_t>(mesh.positions.size());
  const bool mirrors = glm::determinant(glm::dmat3(to_from)) < 0;
  for (const glm::vec3& p : part.positions)
    mesh.positions.emplace_back(glm::vec3(glm::dvec3(to_from * glm::dvec4(glm::dvec3(p), 1.0))));
  for (glm::uvec3 t : part.triangles) {
    if (mirrors) std::swap(t.y, t.z);
    mesh.triangles.push_back(t + base);
  }
}

Mesh transformed(Mesh mesh, const glm::dmat4& to_from) {
  for (glm::vec3& p : mesh.positions) p = glm::vec3(glm::dvec3(to_from * glm::dvec4(glm::dvec3(p), 1.0)));
  if (glm::determinant(glm::dmat3(to_from)) < 0)
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  return mesh;
}

glm::dmat4 moved(const glm::dvec3& offset) {
  return glm::translate(glm::dmat4(1.0), offset);
}
glm::dmat4 scaled(const glm::dvec3& factors) {
  return glm::scale(glm::dmat4(1.0), factors);
}
glm::dmat4 turned_x(double angle) {
  return glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(1, 0, 0));
}
glm::dmat4 turned_y(double angle) {
  return glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0, 1, 0));
}
glm::dmat4 turned_z(double angle) {
  return glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0, 0, 1));
}

glm::dmat4 along(const glm::dvec3& origin, const glm::dvec3& axis) {
  const glm::dvec3 y = glm::normalize(axis);
  const glm::dvec3 helper = std::abs(y.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 z = glm::normalize(glm::cross(helper, y));
  const glm::dvec3 x = glm::cross(y, z);
  return {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(origin, 1)};
}

}  // namespace shadewright::builtin
