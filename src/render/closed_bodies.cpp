#include "render/closed_bodies.h"

#include "voxel/topology.h"

namespace shadewright::render {

std::vector<uint8_t> closed_triangles(const Mesh& mesh) {
  Scene alone;
  alone.meshes = {mesh};
  alone.instances.resize(1);
  return voxel::find_topology(voxel::gather_casters(alone), alone, voxel::ClosedMode::automatic).closed;
}

}  // namespace shadewright::render
