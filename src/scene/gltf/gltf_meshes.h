// The triangles and base colours of a glTF file, each accessor pair read once however many meshes share it.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scene/gltf/gltf_file.h"
#include "scene/scene_graph.h"

namespace shadewright {

class GltfMeshes {
 public:
  explicit GltfMeshes(const GltfFile& file) : file_(file) {}

  /// The triangle primitives of a glTF mesh, each with its material's base colour. Throws InputError.
  const std::vector<GraphPart>& parts(size_t gltf_mesh);
  /// All meshes that `parts` referred to. Call once.
  std::vector<Mesh> take() { return std::move(meshes_); }
  void add_warnings(std::vector<std::string>& warnings) const;

 private:
  /// POSITION accessor, indices accessor + 1 (0 = none), primitive mode: what makes the same triangles.
  using Key = std::array<size_t, 3>;

  uint32_t shared_mesh(const Key& key, const std::string& name);
  glm::vec3 albedo(const nlohmann::json& primitive);

  const GltfFile& file_;
  std::vector<Mesh> meshes_;
  std::map<Key, uint32_t> mesh_of_key_;
  std::map<size_t, std::vector<GraphPart>> parts_of_mesh_;
  size_t points_and_lines_ = 0;
  bool has_morphs_ = false, has_transparency_ = false;
};

}  // namespace shadewright
