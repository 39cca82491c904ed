#include "scene/points/pieces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace shadewright::points {
namespace {

using Corners = std::array<glm::vec3, 3>;

Corners corners_of(const Mesh& mesh, const glm::uvec3& triangle) {
  return {mesh.positions[triangle.x], mesh.positions[triangle.y], mesh.positions[triangle.z]};
}

glm::dvec3 area_vector(const Corners& c) {
  return 0.5 * glm::cross(glm::dvec3(c[1]) - glm::dvec3(c[0]), glm::dvec3(c[2]) - glm::dvec3(c[0]));
}

uint32_t find_root(std::vector<uint32_t>& parents, uint32_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

/// One index for vertices at the same place: a seam in a mesh's indices is no end of its surface.
std::vector<uint32_t> weld(const Mesh& mesh) {
  std::vector<uint32_t> order(mesh.positions.size()), welded(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](uint32_t i) {
    const glm::vec3& p = mesh.positions[i];
    return std::array{p.x, p.y, p.z};
  };
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  for (size_t i = 0; i < order.size(); ++i)
    welded[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? welded[order[i - 1]] : order[i];
  return welded;
}

struct Connections {
  std::vector<uint32_t> component_of_triangle;
  std::vector<Component> components;
};

Connections connect(const Mesh& mesh) {
  const std::vector<uint32_t> welded = weld(mesh);
  std::vector<uint32_t> parents(mesh.positions.size());
  std::iota(parents.begin(), parents.end(), 0u);
  std::vector<std::array<uint32_t, 2>> edges;
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = welded[triangle[k]], b = welded[triangle[(k + 1) % 3]];
      edges.push_back({std::min(a, b), std::max(a, b)});
      const uint32_t p = find_root(parents, a), q = find_root(parents, b);
      parents[std::max(p, q)] = std::min(p, q);
    }
  Connections result;
  constexpr uint32_t unnamed = ~0u;
  std::vector<uint32_t> names(mesh.positions.size(), unnamed);
  const auto name = [&](uint32_t vertex) {
    uint32_t& component = names[find_root(parents, vertex)];
    if (component == unnamed) {
      component = static_cast<uint32_t>(result.components.size());
      result.components.emplace_back();
    }
    return component;
  };
  for (const glm::uvec3& triangle : mesh.triangles) {
    result.component_of_triangle.push_back(name(welded[triangle.x]));
    Component& component = result.components[result.component_of_triangle.back()];
    component.area += glm::length(area_vector(corners_of(mesh, triangle)));
    for (int k = 0; k < 3; ++k) component.box.extend(glm::dvec3(mesh.positions[triangle[k]]));
  }
  std::sort(edges.begin(), edges.end());
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::find_if(first, edges.end(), [&](const auto& edge) { return edge != *first; });
    if (last - first != 2) result.components[name((*first)[0])].closed = false;
    first = last;
  }
  return result;
}

/// Halves the longest edge until it is at most `longest`. False when there would be more than `most` pieces.
bool cut_triangle(const Corners& corners, float longest, uint32_t component, size_t most, std::vector<Piece>& pieces) {
  std::vector<Corners> left{corners};
  while (!left.empty()) {
    const Corners c = left.back();
    left.pop_back();
    size_t edge = 0;
    float length = 0;
    for (size_t k = 0; k < 3; ++k) {
      const float l = glm::distance(c[k], c[(k + 1) % 3]);
      if (l > length) {
        length = l;
        edge = k;
      }
    }
    const glm::vec3 middle = 0.5f * (c[edge] + c[(edge + 1) % 3]);
    if (length > longest && middle != c[edge] && middle != c[(edge + 1) % 3]) {
      left.push_back({middle, c[(edge + 1) % 3], c[(edge + 2) % 3]});
      left.push_back({c[edge], middle, c[(edge + 2) % 3]});
      continue;
    }
    if (pieces.size() >= most) return false;
    const glm::dvec3 n = area_vector(c);
    const double area = glm::length(n);
    if (!(area > 0)) continue;  // cut to nothing
    Piece& piece = pieces.emplace_back();
    piece.corners = c;
    piece.center = glm::vec3((glm::dvec3(c[0]) + glm::dvec3(c[1]) + glm::dvec3(c[2])) / 3.0);
    piece.normal = glm::vec3(n / area);
    piece.area = static_cast<float>(area);
    for (const glm::vec3& p : c) piece.reach = std::max(piece.reach, glm::distance(p, piece.center));
    piece.component = component;
  }
  return true;
}

}  // namespace

double surface_area(const Mesh& mesh) {
  double area = 0;
  for (const glm::uvec3& triangle : mesh.triangles) area += glm::length(area_vector(corners_of(mesh, triangle)));
  return area;
}

Pieces cut(const Mesh& mesh, double longest) {
  Connections connections = connect(mesh);
  const size_t most = 64 * mesh.triangles.size() + 4096;
  Pieces result;
  const auto cut_all = [&](float length) {
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
      if (!cut_triangle(corners_of(mesh, mesh.triangles[t]), length, connections.component_of_triangle[t], most,
                        result.pieces))
        return false;
    return true;
  };
  while (!cut_all(static_cast<float>(longest))) {
    result.pieces.clear();
    longest *= 2;
  }
  result.components = std::move(connections.components);
  return result;
}

}  // namespace shadewright::points
