#include "scene/builtin/shapes/terrain.h"

#include <vector>

namespace shadewright::builtin {

Mesh terrain_sheet(const glm::dvec2& min, const glm::dvec2& max, uint32_t columns, uint32_t rows,
                   const std::function<double(double, double)>& height) {
  Mesh mesh;
  mesh.positions.reserve(size_t{columns + 1} * (rows + 1));
  mesh.triangles.reserve(2 * size_t{columns} * rows);
  for (uint32_t j = 0; j <= rows; ++j) {
    for (uint32_t i = 0; i <= columns; ++i) {
      const double x = min.x + (max.x - min.x) * i / columns, z = min.y + (max.y - min.y) * j / rows;
      mesh.positions.emplace_back(glm::vec3(glm::dvec3(x, height(x, z), z)));
    }
  }
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      const uint32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      // Diagonals alternate, or all slopes would lean one way.
      if ((i + j) % 2 == 0) {
        mesh.triangles.emplace_back(a, c, d);
        mesh.triangles.emplace_back(a, d, b);
      } else {
        mesh.triangles.emplace_back(a, c, b);
        mesh.triangles.emplace_back(b, c, d);
      }
    }
  }
  return mesh;
}

Mesh terrain_solid(const glm::dvec2& min, const glm::dvec2& max, uint32_t columns, uint32_t rows, double bottom,
                   const std::function<double(double, double)>& height) {
  Mesh mesh = terrain_sheet(min, max, columns, rows, height);
  // The border, counter-clockwise seen from above.
  std::vector<uint32_t> border;
  const uint32_t stride = columns + 1;
  for (uint32_t j = 0; j < rows; ++j) border.push_back(j * stride);
  for (uint32_t i = 0; i < columns; ++i) border.push_back(rows * stride + i);
  for (uint32_t j = rows; j > 0; --j) border.push_back(j * stride + columns);
  for (uint32_t i = columns; i > 0; --i) border.push_back(i);

  const uint32_t low = static_cast<uint32_t>(mesh.positions.size()), count = static_cast<uint32_t>(border.size());
  for (uint32_t top : border) {
    const glm::vec3 p = mesh.positions[top];
    mesh.positions.emplace_back(p.x, static_cast<float>(bottom), p.z);
  }
  const uint32_t middle = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.emplace_back(glm::vec3(glm::dvec3(0.5 * (min.x + max.x), bottom, 0.5 * (min.y + max.y))));
  for (uint32_t k = 0; k < count; ++k) {
    const uint32_t next = (k + 1) % count;
    mesh.triangles.emplace_back(low + k, low + next, border[next]);
    mesh.triangles.emplace_back(low + k, border[next], border[k]);
    mesh.triangles.emplace_back(middle, low + next, low + k);
  }
  return mesh;
}

}  // namespace shadewright::builtin
