#include "scene/gltf/gltf_meshes.h"

#include <array>

#include "scene/conditioning.h"

namespace shadewright {
namespace {

using nlohmann::json;

enum Mode : size_t { mode_triangles = 4, mode_strip = 5, mode_fan = 6 };

/// Turns a list of vertices into triangles as the primitive's mode says (glTF 2.0, section 3.7.2.1); a rest that makes
/// no triangle is ignored.
std::vector<glm::uvec3> assemble(const std::vector<uint32_t>& vertices, size_t mode) {
  std::vector<glm::uvec3> triangles;
  const size_t n = vertices.size();
  if (mode == mode_triangles)
    for (size_t i = 0; i + 2 < n; i += 3) triangles.emplace_back(vertices[i], vertices[i + 1], vertices[i + 2]);
  else if (mode == mode_strip)
    for (size_t i = 0; i + 2 < n; ++i)
      triangles.emplace_back(vertices[i], vertices[i + 1 + i % 2], vertices[i + 2 - i % 2]);
  else
    for (size_t i = 0; i + 2 < n; ++i) triangles.emplace_back(vertices[i + 1], vertices[i + 2], vertices[0]);
  return triangles;
}

}  // namespace

uint32_t GltfMeshes::shared_mesh(const Key& key, const std::string& name) {
  const auto [entry, is_new] = mesh_of_key_.try_emplace(key, static_cast<uint32_t>(meshes_.size()));
  if (!is_new) return entry->second;
  const auto& [position_accessor, indices_plus_one, mode] = key;
  Mesh mesh;
  mesh.name = name;
  const std::vector<double> numbers = file_.numbers(position_accessor, 3);
  const size_t count = numbers.size() / 3;
  if (count > std::numeric_limits<uint32_t>::max()) throw file_.error("has a mesh of more than 2^32 vertices");
  mesh.positions.reserve(count);
  for (size_t i = 0; i < count; ++i)
    mesh.positions.emplace_back(glm::dvec3(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]));

  std::vector<uint32_t> vertices;
  if (indices_plus_one > 0) {
    vertices = file_.indices(indices_plus_one - 1);
    for (const uint32_t vertex : vertices)
      if (vertex >= count)
        throw file_.error("has an index out of range: vertex " + std::to_string(vertex) + " of " +
                          std::to_string(count) + " in mesh \"" + name + "\"");
  } else {
    vertices.resize(count);
    for (size_t i = 0; i < count; ++i) vertices[i] = static_cast<uint32_t>(i);
  }
  mesh.triangles = assemble(vertices, mode);
  drop_unused_vertices(mesh);  // many primitives may share one long accessor
  meshes_.push_back(std::move(mesh));
  return entry->second;
}

glm::vec3 GltfMeshes::albedo(const json& primitive) {
  const std::optional<size_t> index = find_size(primitive, "material");
  if (!index) return GraphPart{}.albedo;
  const json& material = file_.item("materials", *index);
  const json* alpha_mode = find_member(material, "alphaMode");
  has_transparency_ |= alpha_mode && alpha_mode->get<std::string>() != "OPAQUE";

  const json* factor = nullptr;
  if (const json* roughness = find_member(material, "pbrMetallicRoughness"))
    factor = find_member(*roughness, "baseColorFactor");
  if (const json* extensions = find_member(material, "extensions"); extensions && !factor)
    if (const json* glossiness = find_member(*extensions, "KHR_materials_pbrSpecularGlossiness"))
      factor = find_member(*glossiness, "diffuseFactor");
  if (!factor) return glm::vec3(1.0f);
  return {factor->at(0).get<float>(), factor->at(1).get<float>(), factor->at(2).get<float>()};
}

const std::vector<GraphPart>& GltfMeshes::parts(size_t gltf_mesh) {
  const auto [entry, is_new] = parts_of_mesh_.try_emplace(gltf_mesh);
  if (!is_new) return entry->second;
  const json& mesh = file_.item("meshes", gltf_mesh);
  for (const json& primitive : mesh.at("primitives")) {
    const size_t mode = find_size(primitive, "mode").value_or(mode_triangles);
    if (mode < mode_triangles) {
      ++points_and_lines_;
      continue;
    }
    if (mode > mode_fan) throw file_.error("has a primitive of unknown mode " + std::to_string(mode));
    has_morphs_ |= find_member(primitive, "targets") != nullptr;
    const std::optional<size_t> positions = find_size(primitive.at("attributes"), "POSITION");
    if (!positions) continue;
    const std::optional<size_t> indices = find_size(primitive, "indices");
    const Key key = {*positions, indices ? *indices + 1 : 0, mode};
    entry->second.push_back({shared_mesh(key, name_of(mesh)), albedo(primitive)});
  }
  return entry->second;
}

void GltfMeshes::add_warnings(std::vector<std::string>& warnings) const {
  if (points_and_lines_ > 0)
    warnings.push_back(std::to_string(points_and_lines_) + " sets of points or lines were left out.");
  if (has_transparency_) warnings.emplace_back("Materials with alpha (masked or blended) are drawn opaque.");
  if (has_morphs_) warnings.emplace_back("Morph targets are left at rest.");
}

}  // namespace shadewright
