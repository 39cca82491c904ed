// The ray from a point of a surface to a light, and whether there is one to cast.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "shadewright/scene/scene.h"

namespace shadewright {

/// Towards one light. All decisions are taken in double: points are float, but a cone's border has no float noise.
class LightRay {
 public:
  explicit LightRay(const Light& light)
      : kind_(light.kind),
        position_(light.position),
        axis_(glm::normalize(light.direction)),
        cosine_outer_(std::cos(light.outer_angle)) {}

  /// To the light from `position`: unit length for a directional light (length() is then infinite), otherwise up to the
  /// light's position (length() is then 1).
  glm::dvec3 towards(const glm::vec3& position) const {
    return kind_ == LightKind::directional ? -axis_ : position_ - glm::dvec3(position);
  }
  float length() const { return kind_ == LightKind::directional ? std::numeric_limits<float>::infinity() : 1.0f; }

  /// True where the light would shine if nothing were in between: the surface faces it, by more than `least_cosine`,
  /// inside a spot's cone.
  bool reaches(const glm::vec3& position, const glm::vec3& normal, double least_cosine = 0) const {
    const glm::dvec3 to_light = towards(position);
    const double least = least_cosine == 0 ? 0 : least_cosine * glm::length(to_light);
    if (!(glm::dot(glm::dvec3(normal), to_light) > least)) return false;
    return kind_ != LightKind::spot || -glm::dot(to_light, axis_) >= cosine_outer_ * glm::length(to_light);
  }

 private:
  LightKind kind_;
  glm::dvec3 position_, axis_;
  double cosine_outer_;
};

}  // namespace shadewright
