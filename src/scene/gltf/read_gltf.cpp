#include "scene/gltf/read_gltf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "scene/gltf/gltf_file.h"
#include "scene/gltf/gltf_meshes.h"

namespace shadewright {
namespace {

using nlohmann::json;

/// The first `count` numbers of an array member; nothing when it is absent. Throws nlohmann's exceptions when it is
/// short.
std::optional<std::vector<double>> find_numbers(const json& object, const char* key, size_t count) {
  const json* member = find_member(object, key);
  if (!member) return std::nullopt;
  std::vector<double> numbers;
  for (size_t i = 0; i < count; ++i) numbers.push_back(member->at(i).get<double>());
  return numbers;
}

std::vector<double> get_numbers(const json& object, const char* key, size_t count) {
  auto numbers = find_numbers(object, key, count);
  if (!numbers) throw BadMember(std::string("\"") + key + "\" is missing");
  return std::move(*numbers);
}

double number_or(const json& object, const char* key, double otherwise) {
  const json* member = find_member(object, key);
  return member ? member->get<double>() : otherwise;
}

glm::dvec3 vec3(const std::vector<double>& n) {
  return {n[0], n[1], n[2]};
}

/// glTF stores x, y, z, w. A quaternion of no length says no rotation.
glm::dquat quaternion(const double* n) {
  const glm::dquat q(n[3], n[0], n[1], n[2]);
  const double length = glm::length(q);
  return length > 0 && std::isfinite(length) ? q / length : glm::dquat(1, 0, 0, 0);
}

class Reader {
 public:
  Reader(const GltfFile& file, const Progress& progress, std::vector<std::string>& warnings)
      : file_(file), progress_(progress), warnings_(warnings), meshes_(file) {}

  SceneGraph read() {
    const json* chosen = chosen_scene();
    if (chosen) graph_.name = name_of(*chosen);
    add_nodes(root_nodes(chosen));
    read_animations();
    graph_.meshes = meshes_.take();
    add_warnings();
    return std::move(graph_);
  }

 private:
  const json* chosen_scene() const {
    if (file_.count("scenes") == 0) return nullptr;
    return &file_.item("scenes", find_size(file_.root(), "scene").value_or(0));
  }

  std::vector<size_t> root_nodes(const json* scene) const {
    std::vector<size_t> roots;
    if (scene) {
      if (const json* nodes = find_member(*scene, "nodes"))
        for (size_t i = 0; i < nodes->size(); ++i) roots.push_back(index_at(*nodes, i));
      return roots;
    }
    std::vector<bool> is_child(file_.count("nodes"), false);
    for (size_t i = 0; i < is_child.size(); ++i)
      if (const json* children = find_member(file_.item("nodes", i), "children"))
        for (size_t k = 0; k < children->size(); ++k)
          if (const size_t child = index_at(*children, k); child < is_child.size()) is_child[child] = true;
    for (size_t i = 0; i < is_child.size(); ++i)
      if (!is_child[i]) roots.push_back(i);
    return roots;
  }

  static size_t index_at(const json& array, size_t i) { return get_size(json{{"index", array.at(i)}}, "index"); }

  /// Depth first, children in the file's order; a node reached twice (a cycle, two parents) is an error.
  void add_nodes(const std::vector<size_t>& roots) {
    struct Pending {
      size_t node;
      std::optional<uint32_t> parent;
    };
    std::vector<Pending> stack;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) stack.push_back({*root, std::nullopt});
    while (!stack.empty()) {
      const Pending next = stack.back();
      stack.pop_back();
      const json& node = file_.item("nodes", next.node);
      const auto index = static_cast<uint32_t>(graph_.nodes.size());
      if (!graph_index_.try_emplace(next.node, index).second)
        throw file_.error("places node " + std::to_string(next.node) + " twice: its nodes are no tree");
      add_node(node, next.parent);
      if (const json* children = find_member(node, "children"))
        for (size_t i = children->size(); i-- > 0;) stack.push_back({index_at(*children, i), index});
      const size_t total = file_.count("nodes");
      if (index % (total / 100 + 1) == 0)
        progress_("load", 0.1 + 0.8 * static_cast<double>(index) / static_cast<double>(total));
    }
  }

  void add_node(const json& json_node, std::optional<uint32_t> parent) {
    GraphNode node;
    node.name = name_of(json_node);
    node.parent = parent;
    if (const auto matrix = find_numbers(json_node, "matrix", 16)) {
      for (int i = 0; i < 16; ++i) node.parent_from_node[i / 4][i % 4] = (*matrix)[static_cast<size_t>(i)];
    } else {
      if (const auto numbers = find_numbers(json_node, "translation", 3)) node.rest_translation = vec3(*numbers);
      if (const auto numbers = find_numbers(json_node, "rotation", 4)) node.rest_rotation = quaternion(numbers->data());
      if (const auto numbers = find_numbers(json_node, "scale", 3)) node.rest_scale = vec3(*numbers);
      node.parent_from_node = glm::mat4_cast(node.rest_rotation);
      for (int column = 0; column < 3; ++column) node.parent_from_node[column] *= node.rest_scale[column];
      node.parent_from_node[3] = glm::dvec4(node.rest_translation, 1.0);
    }
    if (const auto mesh = find_size(json_node, "mesh")) node.parts = meshes_.parts(*mesh);
    has_skins_ |= find_size(json_node, "skin").has_value();
    if (const auto camera = find_size(json_node, "camera")) add_camera(node, json_node, file_.item("cameras", *camera));
    if (const json* extensions = find_member(json_node, "extensions"))
      if (const json* light = find_member(*extensions, "KHR_lights_punctual"))
        add_light(node, get_size(*light, "light"));
    if (const json* extras = find_member(json_node, "extras"))
      if (const json* paths = find_member(*extras, "camera_paths")) add_paths(node, *paths);
    graph_.nodes.push_back(std::move(node));
  }

  void add_camera(GraphNode& node, const json& json_node, const json& json_camera) {
    const json* perspective = find_member(json_camera, "perspective");
    if (!perspective) {
      has_orthographic_ = true;
      return;
    }
    GraphCamera camera;
    camera.camera.name = name_or(node.name, name_of(json_camera), "camera", ++camera_count_);
    camera.camera.fov_y = perspective->at("yfov").get<double>();
    camera.camera.near = number_or(*perspective, "znear", 0.0);
    if (!(camera.camera.fov_y > 0 && camera.camera.fov_y < glm::radians(179.0)))
      throw file_.error("has a camera whose vertical field of view is not between 0 and 179 degrees");
    // What glTF has no word for, as write_glb puts it.
    if (const json* extras = find_member(json_node, "extras")) {
      if (const double distance = number_or(*extras, "target_distance", 0.0); distance > 0) {
        camera.camera.target = {0, 0, -distance};
        camera.target_is_known = true;
      }
      camera.camera.near = number_or(*extras, "near", camera.camera.near);
    }
    camera.camera.near = std::max(camera.camera.near, 0.0);
    node.camera = camera;
  }

  void add_light(GraphNode& node, size_t index) {
    const json& extension = file_.root().at("extensions").at("KHR_lights_punctual");
    const json& json_light = extension.at("lights").at(index);
    Light light;
    light.name = name_or(node.name, name_of(json_light), "light", ++light_count_);
    light.direction = {0, 0, -1};
    const auto type = json_light.at("type").get<std::string>();
    if (type == "spot") {
      light.kind = LightKind::spot;
      const json* spot = find_member(json_light, "spot");
      const double quarter = glm::radians(45.0);  // the extension's default
      light.outer_angle = spot ? number_or(*spot, "outerConeAngle", quarter) : quarter;
      light.outer_angle = std::clamp(light.outer_angle, glm::radians(0.1), glm::radians(89.9));
    } else if (type == "point") {
      light.kind = LightKind::point;
    } else if (type != "directional") {
      return;
    }
    node.light = light;
  }

  void add_paths(GraphNode& node, const json& json_paths) const {
    for (const json& json_path : json_paths) {
      CameraPath path;
      path.name = name_of(json_path);
      for (const json& json_key : json_path.at("keys")) {
        const auto vector = [&](const char* key) { return vec3(get_numbers(json_key, key, 3)); };
        const double time = json_key.at("time").get<double>();
        if (!path.times.empty() && !(time > path.times.back()))
          throw file_.error("has a camera path with unsorted keys");
        path.times.push_back(time);
        Camera camera;
        camera.name = path.name;
        camera.eye = vector("eye");
        camera.target = vector("target");
        camera.up = vector("up");
        camera.fov_y = json_key.at("fov_y").get<double>();
        camera.near = std::max(number_or(json_key, "near", 0.0), 0.0);
        path.keys.push_back(camera);
      }
      node.paths.push_back(std::move(path));
    }
  }

  static std::string name_or(const std::string& node, const std::string& own, const std::string& kind, int number) {
    return !node.empty() ? node : !own.empty() ? own : kind + " " + std::to_string(number);
  }

  void read_animations() {
    for (size_t i = 0; i < file_.count("animations"); ++i) {
      const json& animation = file_.item("animations", i);
      const json& samplers = animation.at("samplers");
      for (const json& channel : animation.at("channels")) {
        const json& target = channel.at("target");
        const auto node = find_size(target, "node");
        const auto found = node ? graph_index_.find(*node) : graph_index_.end();
        if (found == graph_index_.end()) continue;
        // Exporters write a clip for each moving thing, or several for one: of those the first is played.
        if (const auto playing = animation_of_.try_emplace(found->second, i).first; playing->second != i) {
          has_more_animations_ = true;
          continue;
        }
        read_channel(graph_.nodes[found->second], target.at("path").get<std::string>(),
                     samplers.at(get_size(channel, "sampler")));
      }
    }
  }

  void read_channel(GraphNode& node, const std::string& path, const json& sampler) {
    if (path == "translation")
      read_track(node.translations, sampler, 3, [](const double* n) { return glm::dvec3(n[0], n[1], n[2]); });
    else if (path == "scale")
      read_track(node.scales, sampler, 3, [](const double* n) { return glm::dvec3(n[0], n[1], n[2]); });
    else if (path == "rotation")
      read_track(node.rotations, sampler, 4, [](const double* n) { return glm::dquat(n[3], n[0], n[1], n[2]); });
    else
      has_morphs_ = true;
  }

  template <typename Value, typename Make>
  void read_track(Track<Value>& track, const json& sampler, size_t components, const Make& make) {
    if (!track.times.empty()) return;  // a second channel of the same property
    Track<Value> result;
    if (const json* interpolation = find_member(sampler, "interpolation")) {
      const auto name = interpolation->get<std::string>();
      if (name == "STEP") result.interpolation = Interpolation::step;
      if (name == "CUBICSPLINE") result.interpolation = Interpolation::cubic;
    }
    result.times = file_.numbers(get_size(sampler, "input"), 1);
    const std::vector<double> numbers = file_.numbers(get_size(sampler, "output"), components);
    const size_t values_per_key = result.interpolation == Interpolation::cubic ? 3 : 1;
    if (numbers.size() / components < result.times.size() * values_per_key)
      throw file_.error("has an animation with fewer values than keys");
    for (size_t i = 0; i < result.times.size(); ++i)
      if (!std::isfinite(result.times[i]) || (i > 0 && result.times[i] < result.times[i - 1]))
        throw file_.error("has an animation whose key times do not ascend");
    if (!std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); }))
      throw file_.error("has an animation with values that are not finite");
    for (size_t i = 0; i < result.times.size() * values_per_key; ++i)
      result.values.push_back(make(numbers.data() + i * components));
    if constexpr (std::is_same_v<Value, glm::dquat>) normalize_keys(result);
    track = std::move(result);
  }

  /// Rotations are unit quaternions; the tangents of splines are not.
  static void normalize_keys(Track<glm::dquat>& track) {
    const bool cubic = track.interpolation == Interpolation::cubic;
    for (size_t i = cubic ? 1 : 0; i < track.values.size(); i += cubic ? 3 : 1) {
      const glm::dquat q = track.values[i];
      const double xyzw[] = {q.x, q.y, q.z, q.w};
      track.values[i] = quaternion(xyzw);
    }
  }

  void add_warnings() {
    meshes_.add_warnings(warnings_);
    if (const json* used = find_member(file_.root(), "extensionsUsed"); used && used->is_array())
      if (std::ranges::find(*used, json("EXT_mesh_gpu_instancing")) != used->end())
        warnings_.push_back("Instances by EXT_mesh_gpu_instancing are not read: each of their meshes is drawn once.");
    if (has_skins_) warnings_.push_back("Skinned meshes are drawn in the pose that they were modelled in.");
    if (has_morphs_) warnings_.push_back("Morph targets are not played.");
    if (has_orthographic_) warnings_.push_back("Orthographic cameras were left out.");
    if (has_more_animations_) warnings_.push_back("Only the first animation of each node is played.");
  }

  const GltfFile& file_;
  const Progress& progress_;
  std::vector<std::string>& warnings_;
  GltfMeshes meshes_;
  SceneGraph graph_;
  std::map<size_t, uint32_t> graph_index_;
  std::map<uint32_t, size_t> animation_of_;  ///< which one moves a node of the graph
  int camera_count_ = 0, light_count_ = 0;
  bool has_skins_ = false, has_morphs_ = false, has_orthographic_ = false, has_more_animations_ = false;
};

}  // namespace

SceneGraph read_gltf(const std::string& path, const Progress& progress, std::vector<std::string>& warnings) {
  progress("load", 0.0);
  try {
    const GltfFile file = GltfFile::read(path);
    return Reader(file, progress, warnings).read();
  } catch (const BadMember& bad) {
    throw InputError(path, std::string("is not a valid glTF scene: ") + bad.what(), "export the file again");
  } catch (const nlohmann::json::exception&) {
    // A member of another type than glTF gives it, or missing.
    throw InputError(path, "is not a valid glTF scene", "export the file again");
  }
}

}  // namespace shadewright
