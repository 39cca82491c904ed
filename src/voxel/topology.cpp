#include "topology.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <numeric>

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
  uint32_t other;  ///< the corner with the greater index
  uint32_t edge;   ///< 3 * triangle + edge
  bool forward;    ///< from the lower to the greater index
};

/// All half-edges by the lower of their corners, in the order of their edges.
struct HalfEdges {
  std::vector<uint32_t> starts;
  std::vector<HalfEdge> items;
};

HalfEdges sort_half_edges(const Casters& casters) {
  HalfEdges sorted;
  sorted.starts.assign(casters.positions.size() + 1, 0);
  const auto each = [&](auto&& visit) {
    for (uint32_t t = 0; t < casters.triangles.size(); ++t)
      for (uint32_t e = 0; e < 3; ++e) {
        const uint32_t a = casters.triangles[t][int(e)], b = casters.triangles[t][int(e + 1) % 3];
        visit(a, b, 3 * t + e);
      }
  };
  each([&](uint32_t a, uint32_t b, uint32_t) { ++sorted.starts[std::min(a, b) + 1]; });
  std::partial_sum(sorted.starts.begin(), sorted.starts.end(), sorted.starts.begin());
  sorted.items.resize(3 * casters.triangles.size());
  std::vector<uint32_t> next(sorted.starts.begin(), sorted.starts.end() - 1);
  each([&](uint32_t a, uint32_t b, uint32_t edge) {
    sorted.items[next[std::min(a, b)]++] = {std::max(a, b), edge, a < b};
  });
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
  bool balanced = true;
  double volume = 0;  ///< times 6
  Box box;
};

}  // namespace

Topology find_topology(const Casters& casters, const Scene& scene, ClosedMode mode) {
  const size_t count = casters.triangles.size();
  Topology topology;
  topology.neighbours.assign(3 * count, kNoTriangle);
  topology.closed.assign(count, mode == ClosedMode::all ? 1 : 0);
  const HalfEdges sorted = sort_half_edges(casters);
  Components components(count);
  std::vector<uint8_t> unbalanced(count, 0);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, casters.positions.size(), 16384), [&](const auto& range) {
    std::vector<HalfEdge> around;
    for (size_t v = range.begin(); v < range.end(); ++v) {
      around.assign(sorted.items.begin() + sorted.starts[v], sorted.items.begin() + sorted.starts[v + 1]);
      std::stable_sort(around.begin(), around.end(),
                       [](const HalfEdge& a, const HalfEdge& b) { return a.other < b.other; });
      for (size_t begin = 0, end = 0; begin < around.size(); begin = end) {
        int forward = 0;
        for (end = begin; end < around.size() && around[end].other == around[begin].other; ++end) {
          forward += around[end].forward ? 1 : -1;
          components.unite(around[begin].edge / 3, around[end].edge / 3);
        }
        if (forward != 0) std::atomic_ref(unbalanced[around[begin].edge / 3]).store(1, std::memory_order_relaxed);
        if (end - begin == 2 && forward == 0) {
          topology.neighbours[around[begin].edge] = around[begin + 1].edge / 3;
          topology.neighbours[around[begin + 1].edge] = around[begin].edge / 3;
        }
      }
    }
  });

  std::vector<uint32_t>& component = topology.component;
  component.resize(count);
  for (uint32_t t = 0; t < count; ++t) component[t] = components.find(t);
  std::vector<uint32_t> body_of(count, kNoTriangle);  // by root
  std::vector<Body> bodies;
  std::vector<uint32_t> roots;
  for (uint32_t t = 0; t < count; ++t) {
    uint32_t& number = body_of[component[t]];
    if (number == kNoTriangle) {
      number = uint32_t(bodies.size());
      bodies.emplace_back();
      roots.push_back(component[t]);
    }
    Body& body = bodies[number];
    body.balanced &= !unbalanced[t];
    const glm::uvec3 corners = casters.triangles[t];
    const glm::dvec3 base =
        casters.positions[casters.triangles[component[t]].x];  // keeps the sum precise far from zero
    const glm::dvec3 a = casters.positions[corners.x], b = casters.positions[corners.y],
                     c = casters.positions[corners.z];
    body.volume += glm::dot(a - base, glm::cross(b - base, c - base));
    for (const glm::dvec3& p : {a, b, c}) body.box.extend(p);
  }

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
      return bodies[body].box.contains(eye) && contains(casters, component, roots[body], eye);
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
    for (size_t t = 0; t < count; ++t) topology.closed[t] = closed[body_of[component[t]]];
  return topology;
}

}  // namespace shadewright::voxel
