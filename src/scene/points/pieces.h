// A mesh's surface cut into small triangles, for sampling.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright::points {

struct Piece {
  std::array<glm::vec3, 3> corners;
  glm::vec3 center{0.0f};
  glm::vec3 normal{0.0f};  ///< unit
  float area = 0;
  float reach = 0;         ///< from the centre to the farthest corner
  uint32_t component = 0;  ///< which connected piece of the mesh it belongs to
};

/// Triangles that share vertices, by position.
struct Component {
  bool closed = true;  ///< every edge has two triangles
  double area = 0;
  Box box;

  /// How wide it is on average over its length.
  double width() const { return area / box.diagonal(); }
};

struct Pieces {
  std::vector<Piece> pieces;
  std::vector<Component> components;
};

double surface_area(const Mesh& mesh);

/// Cuts `mesh` until no edge is longer than `longest`, or a little coarser where that would be very many pieces.
Pieces cut(const Mesh& mesh, double longest);

}  // namespace shadewright::points
