#include "scene/builtin/shapes/sheet.h"

#include <limits>
#include <vector>

namespace shadewright::builtin {

Mesh sheet(uint32_t columns, uint32_t rows, const std::function<glm::dvec3(uint32_t, uint32_t)>& position,
           const std::function<bool(uint32_t, uint32_t)>& keep) {
  Mesh mesh;
  constexpr uint32_t unused = std::numeric_limits<uint32_t>::max();
  std::vector<uint32_t> index(size_t{columns + 1} * (rows + 1), unused);
  const auto vertex = [&](uint32_t i, uint32_t j) {
    uint32_t& slot = index[size_t{j} * (columns + 1) + i];
    if (slot == unused) {
      slot = static_cast<uint32_t>(mesh.positions.size());
      mesh.positions.emplace_back(glm::vec3(position(i, j)));
    }
    return slot;
  };
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      if (!keep(i, j)) continue;
      const uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
      mesh.triangles.emplace_back(a, b, c);
      mesh.triangles.emplace_back(a, c, d);
    }
  }
  return mesh;
}

}  // namespace shadewright::builtin
