// Small scenes for the tests: random soups and bodies, from a seed that a failing test prints.
#pragma once

#include <cmath>
#include <random>

#include "shadewright/scene/scene.h"

namespace shadewright::voxel {

inline void add_mesh(Scene& scene, Mesh mesh) {
  Instance instance;
  instance.mesh = uint32_t(scene.meshes.size());
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back(instance);
}

/// Outward facing, with welded corners.
inline Mesh box_mesh(const glm::vec3& low, const glm::vec3& high) {
  Mesh mesh;
  for (unsigned i = 0; i < 8; ++i)
    mesh.positions.push_back({(i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z});
  for (const glm::uvec4 q : {glm::uvec4(0, 4, 6, 2), glm::uvec4(1, 3, 7, 5), glm::uvec4(0, 1, 5, 4),
                             glm::uvec4(2, 6, 7, 3), glm::uvec4(0, 2, 3, 1), glm::uvec4(4, 5, 7, 6)}) {
    mesh.triangles.push_back({q.x, q.y, q.z});
    mesh.triangles.push_back({q.x, q.z, q.w});
  }
  return mesh;
}

/// A sphere of rings x rings * 2 quads, bumpy, outward facing.
inline Mesh bumpy_sphere(std::mt19937& random, const glm::vec3& center, float radius, float bumps, uint32_t rings) {
  std::uniform_real_distribution<float> unit(-1, 1);
  Mesh mesh;
  const uint32_t around = rings * 2;
  mesh.positions.push_back(center + glm::vec3(0, radius, 0));
  for (uint32_t i = 1; i < rings; ++i)
    for (uint32_t j = 0; j < around; ++j) {
      const float theta = 3.14159265f * float(i) / float(rings), phi = 6.2831853f * float(j) / float(around);
      const glm::vec3 d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      mesh.positions.push_back(center + d * radius * (1 + bumps * unit(random)));
    }
  mesh.positions.push_back(center - glm::vec3(0, radius, 0));
  const auto at = [&](uint32_t i, uint32_t j) { return 1 + (i - 1) * around + j % around; };
  const uint32_t last = uint32_t(mesh.positions.size()) - 1;
  for (uint32_t j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, at(1, j + 1), at(1, j)});
    mesh.triangles.push_back({last, at(rings - 1, j), at(rings - 1, j + 1)});
    for (uint32_t i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      mesh.triangles.push_back({at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
    }
  }
  return mesh;
}

/// Unconnected triangles of all sizes.
inline Mesh soup(std::mt19937& random, uint32_t triangles, float size) {
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto point = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
  Mesh mesh;
  for (uint32_t t = 0; t < triangles; ++t) {
    const glm::vec3 center = point() * 5.0f;
    const float scale = size * std::exp(1.5f * unit(random));
    for (int i = 0; i < 3; ++i) mesh.positions.push_back(center + point() * scale);
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

/// Overlapping, touching, thin and flat bodies above a slab; some with axis-aligned faces.
inline Scene random_bodies(std::mt19937& random, uint32_t count) {
  std::uniform_real_distribution<float> unit(-1, 1);
  Scene scene;
  add_mesh(scene, box_mesh({-6, -1.5f, -6}, {6, -1, 6}));
  for (uint32_t i = 0; i < count; ++i) {
    const glm::vec3 center(5 * unit(random), 1.5f * unit(random), 5 * unit(random));
    const glm::vec3 half(0.02f + std::abs(unit(random)), 0.01f + std::abs(unit(random)),
                         0.02f + std::abs(unit(random)));
    if (i % 3 == 0)
      add_mesh(scene, box_mesh(center - half, center + half));
    else
      add_mesh(scene, bumpy_sphere(random, center, half.x, i % 3 == 1 ? 0.0f : 0.3f, 4 + i % 9));
    if (i % 4 == 1) scene.instances.back().world_from_mesh[1][1] = 0.03;  // thin
    if (i % 4 == 2) {
      scene.instances.back().world_from_mesh = glm::dmat4(1.0);
      scene.instances.back().world_from_mesh[0] = glm::dvec4(0.6, 0, 0.8, 0);
      scene.instances.back().world_from_mesh[2] = glm::dvec4(-0.8, 0, 0.6, 0);
    }
  }
  return scene;
}

}  // namespace shadewright::voxel
