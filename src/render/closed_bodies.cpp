#include "render/closed_bodies.h"

#include "voxel/topology.h"

namespace shadewright::render {

MeshTopology mesh_topology(const Mesh& mesh) {
  Scene alone;
  alone.meshes = {mesh};
  alone.instances.resize(1);
  voxel::Topology found = voxel::find_topology(voxel::gather_casters(alone), alone, voxel::ClosedMode::automatic);
  MeshTopology result{std::move(found.closed), std::vector<glm::uvec3>(mesh.triangles.size(), glm::uvec3(no_vertex))};
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (uint32_t e = 0; e < 3; ++e) {
      const uint32_t other = found.neighbours[3 * t + e];
      if (other == voxel::kNoTriangle) continue;
      for (uint32_t k = 0; k < 3; ++k)
        if (found.neighbours[3 * other + k] == t)
          result.across[t][static_cast<int>(e)] = mesh.triangles[other][static_cast<int>((k + 2) % 3)];
    }
  return result;
}

}  // namespace shadewright::render
