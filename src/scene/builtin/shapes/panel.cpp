#include "scene/builtin/shapes/panel.h"

#include <limits>

namespace shadewright::builtin {

Mesh panel(std::span<const double> xs, std::span<const double> ys, double back, double front,
           const std::function<bool(size_t, size_t)>& filled) {
  Mesh mesh;
  const size_t columns = xs.size() - 1, rows = ys.size() - 1;
  constexpr uint32_t unused = std::numeric_limits<uint32_t>::max();
  std::vector<uint32_t> index(2 * xs.size() * ys.size(), unused);
  const auto vertex = [&](size_t i, size_t j, bool at_front) {
    uint32_t& slot = index[2 * (j * xs.size() + i) + (at_front ? 1 : 0)];
    if (slot == unused) {
      slot = static_cast<uint32_t>(mesh.positions.size());
      mesh.positions.emplace_back(glm::vec3(glm::dvec3(xs[i], ys[j], at_front ? front : back)));
    }
    return slot;
  };
  const auto quad = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(a, c, d);
  };
  // The side of a cell along the grid edge from p to q, the cell on its left as seen from the front.
  const auto side = [&](size_t pi, size_t pj, size_t qi, size_t qj) {
    quad(vertex(pi, pj, false), vertex(qi, qj, false), vertex(qi, qj, true), vertex(pi, pj, true));
  };
  for (size_t j = 0; j < rows; ++j) {
    for (size_t i = 0; i < columns; ++i) {
      if (!filled(i, j)) continue;
      quad(vertex(i, j, true), vertex(i + 1, j, true), vertex(i + 1, j + 1, true), vertex(i, j + 1, true));
      quad(vertex(i, j, false), vertex(i, j + 1, false), vertex(i + 1, j + 1, false), vertex(i + 1, j, false));
      if (j == 0 || !filled(i, j - 1)) side(i, j, i + 1, j);
      if (i + 1 == columns || !filled(i + 1, j)) side(i + 1, j, i + 1, j + 1);
      if (j + 1 == rows || !filled(i, j + 1)) side(i + 1, j + 1, i, j + 1);
      if (i == 0 || !filled(i - 1, j)) side(i, j + 1, i, j);
    }
  }
  return mesh;
}

}  // namespace shadewright::builtin
