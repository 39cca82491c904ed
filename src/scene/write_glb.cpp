// Scenes to binary glTF 2.0: a root node at the scene's origin, under it one node for each instance, motion, camera and
// light. Meshes share their accessors; a mesh in two colours becomes two glTF meshes over the same accessors.
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <tuple>

#include "scene/conditioning.h"
#include "shadewright/error.h"
#include "shadewright/files.h"
#include "shadewright/geometry/projection.h"
#include "shadewright/scene/load.h"

namespace shadewright {
namespace {

using nlohmann::json;

constexpr int type_float = 5126, type_uint = 5125;
constexpr int target_vertices = 34962, target_indices = 34963;

json to_json(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

json to_json(const glm::dmat4& matrix) {
  json numbers = json::array();
  for (int i = 0; i < 16; ++i) numbers.push_back(matrix[i / 4][i % 4]);
  return numbers;
}

/// world_from_node of a node that looks along its -Z.
glm::dmat4 looking_node(const glm::dvec3& position, const glm::dvec3& forward, const glm::dvec3& up) {
  glm::dmat4 matrix(glm::transpose(glm::dmat3(look_along(position, forward, up))));
  matrix[3] = glm::dvec4(position, 1.0);
  return matrix;
}

class Writer {
 public:
  explicit Writer(const Scene& scene) : scene_(scene) {
    root_ = {{"asset", {{"version", "2.0"}, {"generator", "shadewright"}}},
             {"scene", 0},
             {"scenes", {{{"name", scene.name}, {"nodes", {0}}}}},
             {"nodes", {{{"name", "origin"}, {"translation", to_json(scene.origin)}}}}};
    accessors_of_mesh_.resize(scene.meshes.size());
    node_of_motion_.resize(scene.motions.size());
    for (const Instance& instance : scene.instances) add_instance(instance);
    for (const Camera& camera : scene.cameras) add_camera(camera);
    for (const Light& light : scene.lights) add_light(light);
    add_paths();
    if (!animation_.is_null()) root_["animations"] = {animation_};
    if (!binary_.empty()) root_["buffers"] = {{{"byteLength", binary_.size()}}};
  }

  const json& root() const { return root_; }
  std::span<const char> binary() const { return binary_; }

 private:
  struct MeshAccessors {
    size_t positions = 0, indices = 0;
  };

  template <typename Value>
  size_t add_view(const std::vector<Value>& values, int target = 0) {
    json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", values.size() * sizeof(Value)}};
    if (target != 0) view["target"] = target;
    const auto* first = reinterpret_cast<const char*>(values.data());
    binary_.insert(binary_.end(), first, first + values.size() * sizeof(Value));
    root_["bufferViews"].push_back(view);
    return root_["bufferViews"].size() - 1;
  }

  size_t add_accessor(json accessor) {
    root_["accessors"].push_back(std::move(accessor));
    return root_["accessors"].size() - 1;
  }

  size_t add_node(json node, size_t parent) {
    root_["nodes"].push_back(std::move(node));
    const size_t index = root_["nodes"].size() - 1;
    root_["nodes"][parent]["children"].push_back(index);
    return index;
  }

  const MeshAccessors& accessors_of(uint32_t mesh_index) {
    std::optional<MeshAccessors>& known = accessors_of_mesh_[mesh_index];
    if (known) return *known;
    Mesh mesh = scene_.meshes[mesh_index];
    drop_unused_vertices(mesh);  // they may be anything, and an accessor's bounds hold all
    const Box box = bounds(mesh);
    known = MeshAccessors{add_accessor({{"bufferView", add_view(mesh.positions, target_vertices)},
                                        {"componentType", type_float},
                                        {"count", mesh.positions.size()},
                                        {"type", "VEC3"},
                                        {"min", to_json(box.min)},
                                        {"max", to_json(box.max)}}),
                          add_accessor({{"bufferView", add_view(mesh.triangles, target_indices)},
                                        {"componentType", type_uint},
                                        {"count", 3 * mesh.triangles.size()},
                                        {"type", "SCALAR"}})};
    return *known;
  }

  size_t material_of(const glm::vec3& albedo) {
    const auto [entry, is_new] =
        materials_.try_emplace(std::array<float, 3>{albedo.r, albedo.g, albedo.b}, materials_.size());
    if (is_new)
      root_["materials"].push_back({{"doubleSided", true},
                                    {"pbrMetallicRoughness",
                                     {{"baseColorFactor", {albedo.r, albedo.g, albedo.b, 1.0f}},
                                      {"metallicFactor", 0},
                                      {"roughnessFactor", 1}}}});
    return entry->second;
  }

  size_t gltf_mesh_of(const Instance& instance) {
    const size_t material = material_of(instance.albedo);
    const auto [entry, is_new] = gltf_meshes_.try_emplace(std::pair(instance.mesh, material), gltf_meshes_.size());
    if (is_new) {
      const MeshAccessors& accessors = accessors_of(instance.mesh);
      root_["meshes"].push_back({{"name", scene_.meshes[instance.mesh].name},
                                 {"primitives",
                                  {{{"attributes", {{"POSITION", accessors.positions}}},
                                    {"indices", accessors.indices},
                                    {"material", material}}}}});
    }
    return entry->second;
  }

  void add_instance(const Instance& instance) {
    if (scene_.meshes[instance.mesh].triangles.empty()) return;
    json node = {{"name", instance.name}, {"mesh", gltf_mesh_of(instance)}};
    if (instance.world_from_mesh != glm::dmat4(1.0)) node["matrix"] = to_json(instance.world_from_mesh);
    const bool moves = instance.motion && !scene_.motions[*instance.motion].times.empty();
    add_node(std::move(node), moves ? motion_node(*instance.motion) : 0);
  }

  /// The animated node of a motion, made when its first instance asks.
  size_t motion_node(uint32_t motion_index) {
    std::optional<size_t>& known = node_of_motion_[motion_index];
    if (known) return *known;
    const Motion& motion = scene_.motions[motion_index];
    std::vector<float> times;
    std::vector<glm::vec3> translations;
    std::vector<std::array<float, 4>> rotations;
    for (size_t i = 0; i < motion.times.size(); ++i) {
      const auto time = static_cast<float>(motion.times[i]);
      if (!times.empty() && time <= times.back()) continue;  // closer than floats tell apart
      const glm::quat q(motion.rotations[i]);
      times.push_back(time);
      translations.emplace_back(motion.translations[i]);
      rotations.push_back({q.x, q.y, q.z, q.w});
    }
    const std::array<float, 4>& turn = rotations.front();
    known = add_node(
        {{"name", motion.name}, {"translation", to_json(glm::dvec3(translations.front()))}, {"rotation", turn}}, 0);
    const size_t input = add_accessor({{"bufferView", add_view(times)},
                                       {"componentType", type_float},
                                       {"count", times.size()},
                                       {"type", "SCALAR"},
                                       {"min", {times.front()}},
                                       {"max", {times.back()}}});
    add_channel(*known, "translation", input,
                add_accessor({{"bufferView", add_view(translations)},
                              {"componentType", type_float},
                              {"count", times.size()},
                              {"type", "VEC3"}}));
    add_channel(*known, "rotation", input,
                add_accessor({{"bufferView", add_view(rotations)},
                              {"componentType", type_float},
                              {"count", times.size()},
                              {"type", "VEC4"}}));
    return *known;
  }

  void add_channel(size_t node, const char* path, size_t input, size_t output) {
    animation_["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
    animation_["channels"].push_back(
        {{"sampler", animation_["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }

  /// glTF knows no target and asks for a near distance: both go, exactly, into the node's extras.
  void add_camera(const Camera& camera) {
    const glm::dvec3 forward = camera.target - camera.eye;
    root_["cameras"].push_back(
        {{"name", camera.name},
         {"type", "perspective"},
         {"perspective", {{"yfov", camera.fov_y}, {"znear", std::max(near_distance(scene_, camera), 1e-12)}}}});
    add_node({{"name", camera.name},
              {"camera", root_["cameras"].size() - 1},
              {"matrix", to_json(looking_node(camera.eye, forward, camera.up))},
              {"extras", {{"target_distance", glm::length(forward)}, {"near", camera.near}}}},
             0);
  }

  void add_light(const Light& light) {
    json punctual = {{"name", light.name}};
    punctual["type"] = light.kind == LightKind::directional ? "directional"
                       : light.kind == LightKind::spot      ? "spot"
                                                            : "point";
    if (light.kind == LightKind::spot) punctual["spot"] = {{"outerConeAngle", light.outer_angle}};
    root_["extensionsUsed"] = {"KHR_lights_punctual"};
    json& lights = root_["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back(punctual);
    add_node({{"name", light.name},
              {"matrix", to_json(looking_node(light.position, light.direction, {0, 1, 0}))},
              {"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}},
             0);
  }

  void add_paths() {
    for (const CameraPath& path : scene_.paths) {
      json keys = json::array();
      for (size_t i = 0; i < path.keys.size(); ++i) {
        const Camera& key = path.keys[i];
        keys.push_back({{"time", path.times[i]},
                        {"eye", to_json(key.eye)},
                        {"target", to_json(key.target)},
                        {"up", to_json(key.up)},
                        {"fov_y", key.fov_y},
                        {"near", key.near}});
      }
      root_["nodes"][0]["extras"]["camera_paths"].push_back({{"name", path.name}, {"keys", keys}});
    }
  }

  const Scene& scene_;
  json root_, animation_;
  std::vector<char> binary_;
  std::vector<std::optional<MeshAccessors>> accessors_of_mesh_;
  std::vector<std::optional<size_t>> node_of_motion_;
  std::map<std::array<float, 3>, size_t> materials_;
  std::map<std::pair<uint32_t, size_t>, size_t> gltf_meshes_;
};

void write_word(std::ostream& stream, size_t value) {
  for (int byte = 0; byte < 4; ++byte) stream.put(static_cast<char>(value >> (8 * byte) & 0xFF));
}

}  // namespace

void write_glb(const Scene& scene, const std::filesystem::path& file) {
  const Writer writer(scene);
  // Names may come from anywhere: bytes that are no UTF-8 are replaced.
  std::string text = writer.root().dump(-1, ' ', false, json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const size_t binary_size = writer.binary().size();  // all parts are whole words
  const size_t total = 12 + 8 + text.size() + (binary_size > 0 ? 8 + binary_size : 0);
  if (total > std::numeric_limits<uint32_t>::max())
    throw FailureError(file.string(), "would exceed the 4 GiB that a GLB can hold", "write a smaller scene");

  write_atomically(file, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    stream.write("glTF", 4);
    write_word(stream, 2);
    write_word(stream, total);
    write_word(stream, text.size());
    stream.write("JSON", 4);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    if (binary_size > 0) {
      write_word(stream, binary_size);
      stream.write("BIN\0", 4);
      stream.write(writer.binary().data(), static_cast<std::streamsize>(binary_size));
    }
    stream.close();
    if (!stream)
      throw FailureError(file.string(), "cannot be written",
                         "check the folder, its permissions and the disk's free space");
  });
}

}  // namespace shadewright
