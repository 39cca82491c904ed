// Node animations become rigid motions. A chain of animated nodes has no exact keys of its own (a rotation under a
// rotation moves along a curve), hence the subdivision.
#include <algorithm>
#include <cmath>

#include "scene/scene_graph.h"

namespace shadewright {
namespace {

constexpr double longest_step = 1.0 / 30.0;  // seconds
constexpr double most_keys = 1e5;            // a motion of an hour at 30 Hz; bounds the memory that a file can ask for

glm::dvec3 mix_values(const glm::dvec3& a, const glm::dvec3& b, double share) {
  return glm::mix(a, b, share);
}
glm::dquat mix_values(const glm::dquat& a, const glm::dquat& b, double share) {
  return glm::slerp(a, b, share);
}
glm::dvec3 normalized(const glm::dvec3& value) {
  return value;
}
glm::dquat normalized(const glm::dquat& value) {
  return glm::normalize(value);
}

/// The track's value at `time`, held at both ends; `rest` when it has no keys.
template <typename Value>
Value sample(const Track<Value>& track, double time, const Value& rest) {
  if (track.times.empty()) return rest;
  const bool cubic = track.interpolation == Interpolation::cubic;
  const auto value = [&](size_t key) { return cubic ? track.values[3 * key + 1] : track.values[key]; };
  const auto upper = std::upper_bound(track.times.begin(), track.times.end(), time);
  const auto after = static_cast<size_t>(upper - track.times.begin());
  if (after == 0) return value(0);
  if (after == track.times.size() || track.interpolation == Interpolation::step) return value(after - 1);
  const double seconds = track.times[after] - track.times[after - 1];
  const double s = (time - track.times[after - 1]) / seconds;
  if (!cubic) return mix_values(value(after - 1), value(after), s);
  const double s2 = s * s, s3 = s2 * s;
  const Value out_tangent = track.values[3 * (after - 1) + 2], in_tangent = track.values[3 * after];
  return normalized(value(after - 1) * (2 * s3 - 3 * s2 + 1) + out_tangent * (seconds * (s3 - 2 * s2 + s)) +
                    value(after) * (3 * s2 - 2 * s3) + in_tangent * (seconds * (s3 - s2)));
}

glm::dmat4 local_transform(const GraphNode& node, double time) {
  if (!node.is_animated()) return node.parent_from_node;
  const glm::dvec3 scale = sample(node.scales, time, node.rest_scale);
  glm::dmat4 result = glm::mat4_cast(sample(node.rotations, time, node.rest_rotation));
  for (int column = 0; column < 3; ++column) result[column] *= scale[column];
  result[3] = glm::dvec4(sample(node.translations, time, node.rest_translation), 1.0);
  return result;
}

glm::dmat4 chain_transform(const SceneGraph& graph, uint32_t node, double time) {
  glm::dmat4 result = local_transform(graph.nodes[node], time);
  for (auto parent = graph.nodes[node].parent; parent; parent = graph.nodes[*parent].parent)
    result = local_transform(graph.nodes[*parent], time) * result;
  return result;
}

template <typename Value>
void add_times(const Track<Value>& track, std::vector<double>& times, bool& needs_steps) {
  needs_steps |= track.interpolation == Interpolation::cubic && track.times.size() > 1;
  for (const double time : track.times) {
    // A step becomes a jump between two keys that are neighbours even as floats, which files store.
    if (track.interpolation == Interpolation::step)
      times.push_back(std::nextafter(static_cast<float>(time), -INFINITY));
    times.push_back(time);
  }
}

std::vector<double> key_times(const SceneGraph& graph, uint32_t node) {
  std::vector<double> times;
  int animated = 0;
  bool needs_steps = false;
  for (std::optional<uint32_t> i = node; i; i = graph.nodes[*i].parent) {
    const GraphNode& ancestor = graph.nodes[*i];
    animated += ancestor.is_animated() ? 1 : 0;
    add_times(ancestor.translations, times, needs_steps);
    add_times(ancestor.rotations, times, needs_steps);
    add_times(ancestor.scales, times, needs_steps);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  if (times.size() < 2 || (animated < 2 && !needs_steps)) return times;

  const double step = std::max(longest_step, (times.back() - times.front()) / most_keys);
  std::vector<double> fine;
  for (size_t i = 0; i + 1 < times.size(); ++i) {
    const double seconds = times[i + 1] - times[i];
    const double parts = std::max(1.0, std::ceil(seconds / step));
    for (double part = 0; part < parts; ++part) fine.push_back(times[i] + seconds * part / parts);
  }
  fine.push_back(times.back());
  return fine;
}

/// Departure of `matrix` from a rotation: the largest difference of its columns' products from the identity's.
double shear_of(const glm::dmat3& matrix) {
  const glm::dmat3 products = glm::transpose(matrix) * matrix - glm::dmat3(1.0);
  double largest = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(products[column][row]));
  return largest;
}

bool stands_still(const Motion& motion) {
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b)); };
  for (size_t i = 1; i < motion.times.size(); ++i) {
    const glm::dvec3 &a = motion.translations[0], &b = motion.translations[i];
    if (!same(a.x, b.x) || !same(a.y, b.y) || !same(a.z, b.z)) return false;
    if (1.0 - std::abs(glm::dot(motion.rotations[0], motion.rotations[i])) > 1e-15) return false;
  }
  return true;
}

}  // namespace

std::optional<glm::dmat3> rotation_of(const glm::dmat3& matrix) {
  const double lengths[] = {glm::length(matrix[0]), glm::length(matrix[1]), glm::length(matrix[2])};
  for (const double length : lengths)
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
  const glm::dvec3 x = matrix[0] / lengths[0];
  const glm::dvec3 flat_y = matrix[1] / lengths[1] - x * glm::dot(x, matrix[1] / lengths[1]);
  if (!(glm::length(flat_y) > 1e-9)) return std::nullopt;
  const glm::dvec3 y = glm::normalize(flat_y), z = glm::cross(x, y);
  if (!(std::abs(glm::dot(z, matrix[2] / lengths[2])) > 1e-9)) return std::nullopt;
  return glm::dmat3(x, y, z);
}

std::vector<glm::dmat4> node_transforms(const SceneGraph& graph, double time) {
  std::vector<glm::dmat4> result;
  result.reserve(graph.nodes.size());
  for (const GraphNode& node : graph.nodes) {
    const glm::dmat4 local = local_transform(node, time);
    result.push_back(node.parent ? result[*node.parent] * local : local);
  }
  return result;
}

BakedMotion bake_motion(const SceneGraph& graph, uint32_t mover) {
  BakedMotion result;
  // world_from_mover(t) = rotation(t) * stretch + translation(t), with a constant stretch if the motion is rigid.
  const std::vector<double> times = key_times(graph, mover);
  const glm::dmat3 first(chain_transform(graph, mover, times.front()));
  const std::optional<glm::dmat3> first_rotation = rotation_of(first);
  if (!first_rotation) return result;  // flattened to nothing: there is no motion to see
  const glm::dmat3 stretch = glm::transpose(*first_rotation) * first;
  const glm::dmat3 unstretch = glm::inverse(stretch);

  Motion& motion = result.motion;
  motion.name = graph.nodes[mover].name;
  for (const double time : times) {
    const glm::dmat4 world_from_mover = chain_transform(graph, mover, time);
    const glm::dmat3 turned = glm::dmat3(world_from_mover) * unstretch;
    result.is_rigid &= shear_of(turned) < 1e-3;
    const std::optional<glm::dmat3> rotation = rotation_of(turned);
    glm::dquat key = rotation ? glm::quat_cast(*rotation) : glm::dquat(1, 0, 0, 0);
    if (!motion.rotations.empty() && glm::dot(motion.rotations.back(), key) < 0) key = -key;
    motion.times.push_back(time);
    motion.translations.emplace_back(world_from_mover[3]);
    motion.rotations.push_back(glm::normalize(key));
  }
  if (stands_still(motion)) {
    motion = {};
    return result;
  }
  result.rest_from_mover = glm::dmat4(stretch);
  return result;
}

}  // namespace shadewright
