// From a file's nodes to a Scene: transforms composed in double, one instance for each mesh at each node.
#include <algorithm>
#include <cmath>
#include <map>

#include "scene/scene_graph.h"
#include "shadewright/geometry/projection.h"

namespace shadewright {
namespace {

bool is_usable(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!(std::abs(matrix[column][row]) < 1e30)) return false;
  return rotation_of(glm::dmat3(matrix)).has_value();
}

glm::dvec3 transform_point(const glm::dmat4& matrix, const glm::dvec3& p) {
  return glm::dvec3(matrix * glm::dvec4(p, 1.0));
}

glm::dvec3 transform_direction(const glm::dmat4& matrix, const glm::dvec3& direction) {
  return glm::normalize(glm::dmat3(matrix) * direction);
}

Camera transform_camera(const glm::dmat4& world_from_node, const Camera& camera) {
  Camera result = camera;
  result.eye = transform_point(world_from_node, camera.eye);
  result.target = transform_point(world_from_node, camera.target);
  result.up = transform_direction(world_from_node, camera.up);
  return result;
}

/// A camera that is level gets +Y as its up, which is what orbiting needs; the picture is the same.
void level_up(Camera& camera) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::cross(forward, camera.up);
  const bool is_level = std::abs(right.y) < 1e-6 * glm::length(right) && camera.up.y > 0;
  if (is_level && std::abs(forward.y) < 0.999) camera.up = {0, 1, 0};
}

/// Puts a target that only says a direction as far away as the scene's centre is in that direction.
void choose_target(Camera& camera, const Box& scene_box) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const double depth = scene_box.empty() ? 1.0 : glm::dot(scene_box.center() - camera.eye, forward);
  camera.target = camera.eye + forward * std::max({depth, 0.1 * scene_box.diagonal(), 1e-6});
}

/// Instances of all nodes, with one Motion for each node that moves others.
class Instancer {
 public:
  Instancer(const SceneGraph& graph, Scene& scene) : graph_(graph), scene_(scene) {}

  void add(uint32_t node_index, const glm::dmat4& world_from_node) {
    const GraphNode& node = graph_.nodes[node_index];
    Instance instance;
    instance.name = node.name;
    instance.world_from_mesh = world_from_node;
    if (const std::optional<uint32_t> mover = mover_of(node_index)) {
      const Moved& moved = moved_by(*mover);
      instance.motion = moved.motion;
      if (moved.motion) instance.world_from_mesh = moved.rest_from_mover * mover_from_node(*mover, node_index);
    }
    if (!is_usable(instance.world_from_mesh)) {
      ++flat_instances_;
      return;
    }
    for (const GraphPart& part : node.parts) {
      instance.mesh = part.mesh;
      instance.albedo = glm::clamp(part.albedo, 0.0f, 1.0f);
      scene_.instances.push_back(instance);
    }
  }

  bool moves(uint32_t node) const { return mover_of(node).has_value(); }
  bool has_non_rigid() const { return has_non_rigid_; }
  size_t flat_instances() const { return flat_instances_; }

 private:
  std::optional<uint32_t> mover_of(uint32_t node) const {
    std::optional<uint32_t> mover = node;
    while (mover && !graph_.nodes[*mover].is_animated()) mover = graph_.nodes[*mover].parent;
    return mover;
  }

  /// What an animated node does to all that hangs below it.
  struct Moved {
    std::optional<uint32_t> motion;  ///< index into Scene::motions; none: it stands still
    glm::dmat4 rest_from_mover{1.0};
  };

  /// Baked once, however much hangs below.
  const Moved& moved_by(uint32_t mover) {
    const auto [entry, is_new] = moved_.try_emplace(mover);
    if (!is_new) return entry->second;
    BakedMotion baked = bake_motion(graph_, mover);
    has_non_rigid_ |= !baked.is_rigid;
    entry->second.rest_from_mover = baked.rest_from_mover;
    if (!baked.motion.times.empty()) {
      entry->second.motion = static_cast<uint32_t>(scene_.motions.size());
      scene_.motions.push_back(std::move(baked.motion));
    }
    return entry->second;
  }

  glm::dmat4 mover_from_node(uint32_t mover, uint32_t node) const {
    glm::dmat4 result(1.0);
    for (uint32_t i = node; i != mover; i = *graph_.nodes[i].parent) result = graph_.nodes[i].parent_from_node * result;
    return result;
  }

  const SceneGraph& graph_;
  Scene& scene_;
  std::map<uint32_t, Moved> moved_;
  bool has_non_rigid_ = false;
  size_t flat_instances_ = 0;
};

/// Leaves out meshes that no instance uses.
void drop_unused_meshes(Scene& scene) {
  std::vector<bool> used(scene.meshes.size(), false);
  for (const Instance& instance : scene.instances) used[instance.mesh] = true;
  std::vector<uint32_t> new_index(scene.meshes.size(), 0);
  std::vector<Mesh> kept;
  for (size_t i = 0; i < scene.meshes.size(); ++i) {
    new_index[i] = static_cast<uint32_t>(kept.size());
    if (used[i]) kept.push_back(std::move(scene.meshes[i]));
  }
  scene.meshes = std::move(kept);
  for (Instance& instance : scene.instances) instance.mesh = new_index[instance.mesh];
}

}  // namespace

Scene flatten(SceneGraph graph, std::vector<std::string>& warnings) {
  Scene scene;
  scene.name = graph.name;
  Instancer instancer(graph, scene);
  const std::vector<glm::dmat4> world_from_node = node_transforms(graph, 0.0);
  std::vector<size_t> cameras_without_target;
  bool has_moving_view = false;
  for (uint32_t i = 0; i < graph.nodes.size(); ++i) {
    const GraphNode& node = graph.nodes[i];
    if (!node.parts.empty()) instancer.add(i, world_from_node[i]);
    if (!is_usable(world_from_node[i])) continue;
    has_moving_view |= (node.camera || node.light) && instancer.moves(i);
    if (node.camera) {
      if (!node.camera->target_is_known) cameras_without_target.push_back(scene.cameras.size());
      scene.cameras.push_back(transform_camera(world_from_node[i], node.camera->camera));
      level_up(scene.cameras.back());
    }
    if (node.light) {
      Light light = *node.light;
      light.position = transform_point(world_from_node[i], light.position);
      light.direction = transform_direction(world_from_node[i], light.direction);
      scene.lights.push_back(light);
    }
    for (CameraPath path : node.paths) {
      for (Camera& key : path.keys) key = transform_camera(world_from_node[i], key);
      scene.paths.push_back(std::move(path));
    }
  }
  scene.meshes = std::move(graph.meshes);
  drop_unused_meshes(scene);
  const Box box = cameras_without_target.empty() ? Box{} : bounds(scene);
  for (const size_t camera : cameras_without_target) choose_target(scene.cameras[camera], box);

  if (instancer.flat_instances() > 0)
    warnings.push_back(std::to_string(instancer.flat_instances()) + " nodes are scaled to nothing and were left out.");
  if (instancer.has_non_rigid()) warnings.push_back("An animation scales or shears; only its rigid part is played.");
  if (has_moving_view) warnings.push_back("Animated cameras and lights stand still, where they are at time 0.");
  return scene;
}

}  // namespace shadewright
