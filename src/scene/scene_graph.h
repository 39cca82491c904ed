// A file's nodes as a reader finds them, before they become a Scene: the common form of glTF and of what assimp reads.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright {

enum class Interpolation { linear, step, cubic };

/// One animated quantity. Times ascend, in seconds. For `cubic` each key has three values: in-tangent, value,
/// out-tangent (glTF 2.0, appendix C); otherwise one.
template <typename Value>
struct Track {
  std::vector<double> times;
  std::vector<Value> values;
  Interpolation interpolation = Interpolation::linear;
};

/// A mesh drawn at a node.
struct GraphPart {
  uint32_t mesh = 0;
  glm::vec3 albedo{0.7f};
};

/// A camera in its node's space.
struct GraphCamera {
  Camera camera;
  bool target_is_known = false;  ///< otherwise the target only says the direction, and its distance is chosen
};

/// A node's transform comes from `parent_from_node` unless one of its tracks has keys; then from the tracks, with the
/// rest values for those without.
struct GraphNode {
  std::string name;
  std::optional<uint32_t> parent;  ///< an index below the node's own
  glm::dmat4 parent_from_node{1.0};
  glm::dvec3 rest_translation{0.0};
  glm::dquat rest_rotation{1, 0, 0, 0};
  glm::dvec3 rest_scale{1.0};
  Track<glm::dvec3> translations;
  Track<glm::dquat> rotations;
  Track<glm::dvec3> scales;
  std::vector<GraphPart> parts;
  std::optional<GraphCamera> camera;
  std::optional<Light> light;
  std::vector<CameraPath> paths;

  bool is_animated() const { return !translations.times.empty() || !rotations.times.empty() || !scales.times.empty(); }
};

struct SceneGraph {
  std::string name;
  std::vector<Mesh> meshes;
  std::vector<GraphNode> nodes;  ///< parents before children
};

/// `world_from_node` of every node at `time` seconds.
std::vector<glm::dmat4> node_transforms(const SceneGraph& graph, double time);

/// The rotation of `matrix`'s linear part by orthonormalising its columns in order; nothing when they are dependent.
std::optional<glm::dmat3> rotation_of(const glm::dmat3& matrix);

/// The motion of an animated node, under ancestors that may be, as a rigid part and a constant rest: for each time,
/// world_from_mover = pose(motion, time) * rest_from_mover.
struct BakedMotion {
  Motion motion;  ///< empty when the node turns out to stand still
  glm::dmat4 rest_from_mover{1.0};
  bool is_rigid = true;  ///< false: the file also scales or shears over time, which was left out
};

/// Bakes the chain of the animated node `mover` and its ancestors at the union of their key times, subdivided to 1/30 s
/// where the chain does not interpolate as a Motion does (more than one of them animated, or steps or splines).
BakedMotion bake_motion(const SceneGraph& graph, uint32_t mover);

/// The scene of all nodes at time 0, with motions baked. Adds a warning for each kind of thing that a Scene cannot say.
Scene flatten(SceneGraph graph, std::vector<std::string>& warnings);

}  // namespace shadewright
