// Bodies with joints: a walk as rigid motions of thirteen bones, and people to stand in streets.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "scene/builtin/random.h"
#include "scene/builtin/stage.h"

namespace shadewright::builtin {

/// Left is towards -Z when the figure looks along +X. Pelvis, chest and head reach up from their joint (+Y), limbs hang
/// down from theirs (-Y).
enum class Bone {
  pelvis,
  chest,
  head,
  upper_arm_left,
  upper_arm_right,
  forearm_left,
  forearm_right,
  thigh_left,
  thigh_right,
  shin_left,
  shin_right,
  foot_left,
  foot_right,
  count
};

constexpr size_t bone_count = static_cast<size_t>(Bone::count);

/// Lengths from joint to joint, metres, of a figure 1.75 m tall.
namespace figure_size {
constexpr double thigh = 0.43, shin = 0.41, ankle = 0.09, pelvis = 0.12, chest = 0.42, neck = 0.09, upper_arm = 0.29,
                 forearm = 0.26;
constexpr double hip_half = 0.095, shoulder_half = 0.2;
}  // namespace figure_size

/// Where each bone is (figure from bone, rigid) in a walk along +X; `phase` in radians, 2 pi a double step. The lower
/// foot's sole is at y = 0 and the pelvis above x = z = 0.
std::array<glm::dmat4, bone_count> walk_pose(double phase);

/// How far a figure goes in one double step, metres.
constexpr double double_step = 1.36;

/// A person in clothes, posed in mid-walk at `phase`, some 1,900 triangles. Shirt or dress takes the dye.
Prop person(Scene& scene, double phase, Random& random);

}  // namespace shadewright::builtin
