// octahedral.glsl for the host: a unit vector as a point of [-1, 1]^2 and back (Cigolle et al. 2014).
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

namespace shadewright::render {

/// The square's lower half folded out over its corners, which undoes itself.
inline glm::vec2 octahedral_fold(const glm::vec2& p) {
  return (1.0f - glm::abs(glm::vec2(p.y, p.x))) * glm::vec2(p.x >= 0 ? 1.0f : -1.0f, p.y >= 0 ? 1.0f : -1.0f);
}

inline glm::vec2 octahedral_encode(const glm::vec3& n) {
  const glm::vec2 p = glm::vec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  return n.z >= 0 ? p : octahedral_fold(p);
}

/// The direction of a vector of any length but 0, as 2 x snorm16.
inline uint32_t octahedral_packed(const glm::dvec3& v) {
  return glm::packSnorm2x16(octahedral_encode(glm::vec3(glm::normalize(v))));
}

/// The vector's direction; its length is between 0.57 and 1.
inline glm::vec3 octahedral_direction(const glm::vec2& p) {
  const float z = 1.0f - std::abs(p.x) - std::abs(p.y);
  return {z >= 0 ? p : octahedral_fold(p), z};
}

}  // namespace shadewright::render
