#include "topology.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <numeric>
#include <unordered_map>

#include "shadewright/geometry/box.h"

namespace shadewright::voxel {

namespace {

/// Union-find over triangles from many threads: the lower root wins, so that roots do not depend on timing.
class Components {
 public:
  explicit Components(size_t count) : parent_(std::make_unique<std::atomic<uint32_t>[]>(count)) {
    for (size_t i = 0; i < count; ++i) parent_[i].store(uint32_t(i), std::memory_order_relaxed);
  }
  uint32_t find(uint32_t i) {
    for (;;) {
      uint32_t parent = parent_[i].load(std::memory_order_relaxed);
      if (parent == i) return i;
      const uint32_t grandparent = parent_[parent].load(std::memory_order_relaxed);
      parent_[i].compare_exchange_weak(parent, grandparent, std::memory_order_relaxed);
      i = grandparent;
    }
  }
  void unite(uint32_t a, uint32_t b) {
    for (;;) {
      a = find(a), b = find(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      uint32_t expected = a;
      if (parent_[a].compare_exchange_strong(expected, b)) return;
    }
  }

 private:
  std::unique_ptr<std::atomic<uint32_t>[]> parent_;
};

struct HalfEdge {
  uint32_t other;      ///< the corner with the greater index
  uint32_t edge_bits;  ///< (3 * triangle + edge) << 1 | from the lower to the greater index

  uint32_t edge() const { return edge_bits >> 1; }
  bool forward() const { return edge_bits & 1; }
  bool operator<(const HalfEdge& b) const { return other != b.other ? other < b.other : edge_bits < b.edge_bits; }
};

/// All half-edges by the lower of their corners, each corner's in any order.
struct HalfEdges {
  std::vector<uint32_t> starts;
  std::vector<HalfEdge> items;
};

HalfEdges sort_half_edges(const Casters& casters) {
  HalfEdges sorted;
  sorted.starts.assign(casters.positions.size() + 1, 0);
  const auto each = [&](auto&& visit) {
    tbb::parallel_for(tbb::blocked_range<uint32_t>(0, uint32_t(casters.triangles.size()), 16384),
                      [&](const auto& range) {
                        for (uint32_t t = range.begin(); t < range.end(); ++t)
                          for (uint32_t e = 0; e < 3; ++e)
                            visit(casters.triangles[t][int(e)], casters.triangles[t][int(e + 1) % 3], 3 * t + e);
                      });
  };
  const auto count = [](uint32_t& counter) { return std::atomic_ref(counter).fetch_add(1, std::memory_order_relaxed); };
  each([&](uint32_t a, uint32_t b, uint32_t) { count(sorted.starts[std::min(a, b)]); });
  std::exclusive_scan(sorted.starts.begin(), sorted.starts.end(), sorted.starts.begin(), 0u);
  sorted.items.resize(3 * casters.triangles.size());
  // Filling moves every start to its end, which is the next one's start.
  each([&](uint32_t a, uint32_t b, uint32_t edge) {
    sorted.items[count(sorted.starts[std::min(a, b)])] = {std::max(a, b), edge << 1 | uint32_t(a < b)};
  });
  std::copy_backward(sorted.starts.begin(), sorted.starts.end() - 1, sorted.starts.end());
  sorted.starts[0] = 0;
  return sorted;
}

/// Parity of a ray's crossings, by the component's triangles: is the point inside?
bool contains(const Casters& casters, const std::vector<uint32_t>& component, uint32_t which, const glm::dvec3& point) {
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.31415926, 0.8, 0.2718281));  // meets no edge of a tidy model
  int winding = 0;
  for (size_t t = 0; t < casters.triangles.size(); ++t) {
    if (component[t] != which) continue;
    const glm::dvec3 a = casters.positions[casters.triangles[t].x] - point;
    const glm::dvec3 b = casters.positions[casters.triangles[t].y] - point;
    const glm::dvec3 c = casters.positions[casters.triangles[t].z] - point;
    const double u = glm::dot(direction, glm::cross(b, c)), v = glm::dot(direction, glm::cross(c, a)),
                 w = glm::dot(direction, glm::cross(a, b)), sum = u + v + w;
    const bool front = u > 0 && v > 0 && w > 0, back = u < 0 && v < 0 && w < 0;
    if ((front || back) && glm::dot(a, glm::cross(b, c)) / sum > 0) winding += front ? 1 : -1;
  }
  return winding != 0;
}

struct Body {
  uint32_t root = 0;  ///< its component
  bool balanced = true;
  double volume = 0;  ///< times 6
  Box box;
};

/// In the order of their first triangles. Sums run over chunks of a fixed size, so that they round alike for any
/// threads.
std::vector<Body> find_bodies(const Casters& casters, const std::vector<uint32_t>& component,
                              const std::vector<uint8_t>& unbalanced) {
  const size_t count = casters.triangles.size(), chunk = 65536, chunks = (count + chunk - 1) / chunk;
  std::vector<std::vector<Body>> parts(chunks);
  tbb::parallel_for(size_t(0), chunks, [&](size_t c) {
    for (size_t t = c * chunk; t < std::min(count, (c + 1) * chunk); ++t) {
      if (parts[c].empty() || parts[c].back().root != component[t]) parts[c].push_back({component[t], true, 0, {}});
      Body& body = parts[c].back();
      body.balanced &= !unbalanced[t];
      const glm::uvec3 corners = casters.triangles[t];
      const glm::dvec3 base = casters.positions[casters.triangles[component[t]].x];  // keeps sums precise far from zero
      const glm::dvec3 a = casters.positions[corners.x], b = casters.positions[corners.y],
                       p = casters.positions[corners.z];
      body.volume += glm::dot(a - base, glm::cross(b - base, p - base));
      for (const glm::dvec3& corner : {a, b, p}) body.box.extend(corner);
    }
  });
  std::vector<Body> bodies;
  std::unordered_map<uint32_t, size_t> number;
  for (const std::vector<Body>& part : parts)
    for (const Body& piece : part) {
      const auto [at, fresh] = number.emplace(piece.root, bodies.size());
      if (fresh) {
        bodies.push_back(piece);
        continue;
      }
      Body& body = bodies[at->second];
      body.balanced &= piece.balanced;
      body.volume += piece.volume;
      body.box.extend(piece.box);
    }
  return bodies;
}

}  // namespace

Topology find_topology(const Casters& casters, const Scene& scene, ClosedMode mode) {
  const size_t count = casters.triangles.size();
  Topology topology;
  topology.neighbours.assign(3 * count, kNoTriangle);
  topology.closed.assign(count, mode == ClosedMode::all ? 1 : 0);
  HalfEdges sorted = sort_half_edges(casters);
  Components components(count);
  std::vector<uint8_t> unbalanced(count, 0);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, casters.positions.size(), 16384), [&](const auto& range) {
    for (size_t v = range.begin(); v < range.end(); ++v) {
      const auto begin = sorted.items.begin() + sorted.starts[v], end = sorted.items.begin() + sorted.starts[v + 1];
      std::sort(begin, end);
      for (auto edge = begin, next = begin; edge != end; edge = next) {
        int forward = 0;
        for (; next != end && next->other == edge->other; ++next) {
          forward += next->forward() ? 1 : -1;
          components.unite(edge->edge() / 3, next->edge() / 3);
        }
        if (forward != 0) std::atomic_ref(unbalanced[edge->edge() / 3]).store(1, std::memory_order_relaxed);
        if (next - edge == 2 && forward == 0) {
          topology.neighbours[edge->edge()] = edge[1].edge() / 3;
          topology.neighbours[edge[1].edge()] = edge->edge() / 3;
        }
      }
    }
  });

  std::vector<uint32_t>& component = topology.component;
  component.resize(count);
  tbb::parallel_for(tbb::blocked_range<uint32_t>(0, uint32_t(count), 16384), [&](const auto& range) {
    for (uint32_t t = range.begin(); t < range.end(); ++t) component[t] = components.find(t);
  });
  const std::vector<Body> bodies = find_bodies(casters, component, unbalanced);
  std::vector<uint32_t> body_of(count, kNoTriangle);  // by root
  for (uint32_t body = 0; body < bodies.size(); ++body) body_of[bodies[body].root] = body;

  std::vector<glm::dvec3> eyes;
  for (const Camera& camera : scene.cameras) eyes.push_back(camera.eye);
  for (const CameraPath& path : scene.paths)
    for (const Camera& key : path.keys) eyes.push_back(key.eye);
  std::vector<uint8_t> closed(bodies.size(), 0);
  const auto note = [&](size_t body, const char* why) {
    if (topology.components.notes.size() >= 10) return;
    const glm::dvec3 at = bodies[body].box.center();
    topology.components.notes.push_back(
        fmt::format("the closed body around ({:.3g}, {:.3g}, {:.3g}) {} and counts as open", at.x, at.y, at.z, why));
  };
  for (size_t body = 0; body < bodies.size(); ++body) {
    const auto inside = [&](const glm::dvec3& eye) {
      return bodies[body].box.contains(eye) && contains(casters, component, bodies[body].root, eye);
    };
    if (!bodies[body].balanced) {
      ++topology.components.open;
    } else if (!(bodies[body].volume > 0)) {
      ++topology.components.inwards;
      note(body, "is oriented inwards");
    } else if (std::any_of(eyes.begin(), eyes.end(), inside)) {
      ++topology.components.inhabited;
      note(body, "contains a camera");
    } else {
      ++topology.components.closed;
      closed[body] = 1;
    }
  }
  if (mode == ClosedMode::automatic)
    tbb::parallel_for(size_t(0), count, [&](size_t t) { topology.closed[t] = closed[body_of[component[t]]]; });
  return topology;
}

}  // namespace shadewright::voxel
