#include "casters.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <bit>
#include <memory>

namespace shadewright::voxel {

namespace {

uint64_t hash_position(const glm::dvec3& p) {
  uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    hash = (hash ^ std::bit_cast<uint64_t>(p[axis] + 0.0)) * 0xff51afd7ed558ccdull;  // + 0.0: -0 is 0
    hash ^= hash >> 32;
  }
  return hash;
}

/// For each position the lowest index with the same position, whatever the threads' timing.
std::vector<uint32_t> weld(const std::vector<glm::dvec3>& positions) {
  const size_t size = std::bit_ceil(positions.size() * 2 + 1);
  const auto table = std::make_unique<std::atomic<uint32_t>[]>(size);
  constexpr uint32_t kFree = ~0u;
  const tbb::blocked_range<size_t> slots(0, size, 65536), vertices(0, positions.size(), 16384);
  tbb::parallel_for(slots, [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) table[i].store(kFree, std::memory_order_relaxed);
  });
  std::vector<uint32_t> slot_of(positions.size());
  tbb::parallel_for(vertices, [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) {
      size_t slot = hash_position(positions[i]) & (size - 1);
      for (;; slot = (slot + 1) & (size - 1)) {
        uint32_t held = kFree;
        if (table[slot].compare_exchange_strong(held, uint32_t(i)) || positions[held] == positions[i]) {
          while (held != kFree && uint32_t(i) < held && !table[slot].compare_exchange_weak(held, uint32_t(i))) {
          }
          break;
        }
      }
      slot_of[i] = uint32_t(slot);
    }
  });
  tbb::parallel_for(vertices, [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) slot_of[i] = table[slot_of[i]].load(std::memory_order_relaxed);
  });
  return slot_of;
}

}  // namespace

Casters gather_casters(const Scene& scene) {
  Casters casters;
  std::vector<size_t> first_position, first_triangle;
  size_t positions = 0, triangles = 0;
  for (const Instance& instance : scene.instances) {
    first_position.push_back(positions);
    first_triangle.push_back(triangles);
    if (instance.motion) {
      ++casters.moving_instances;
      continue;
    }
    positions += scene.meshes[instance.mesh].positions.size();
    triangles += scene.meshes[instance.mesh].triangles.size();
  }
  casters.positions.resize(positions);
  casters.triangles.resize(triangles);
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (instance.motion) continue;
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::dmat4 world_from_mesh = transform_at(scene, instance, 0.0);
    tbb::parallel_for(tbb::blocked_range<size_t>(0, mesh.positions.size(), 16384), [&](const auto& range) {
      for (size_t v = range.begin(); v < range.end(); ++v)
        casters.positions[first_position[i] + v] =
            glm::dvec3(world_from_mesh * glm::dvec4(glm::dvec3(mesh.positions[v]), 1.0));
    });
  }
  const std::vector<uint32_t> welded = weld(casters.positions);
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (instance.motion) continue;
    const Mesh& mesh = scene.meshes[instance.mesh];
    const bool mirrored = glm::determinant(glm::dmat3(instance.world_from_mesh)) < 0;
    tbb::parallel_for(tbb::blocked_range<size_t>(0, mesh.triangles.size(), 16384), [&](const auto& range) {
      for (size_t t = range.begin(); t < range.end(); ++t) {
        const glm::uvec3 corners = mesh.triangles[t] + glm::uvec3(uint32_t(first_position[i]));
        glm::uvec3 triangle(welded[corners.x], welded[corners.y], welded[corners.z]);
        if (mirrored) std::swap(triangle.y, triangle.z);  // glTF: a mirroring transform turns the winding
        casters.triangles[first_triangle[i] + t] = triangle;
      }
    });
  }
  return casters;
}

}  // namespace shadewright::voxel
