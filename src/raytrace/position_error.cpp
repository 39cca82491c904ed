#include <glm/glm.hpp>

#include "shadewright/raytrace/tracer.h"

namespace shadewright {

float position_error(const glm::vec3& position, const glm::vec3& eye) {
  constexpr float factor = 16.0f;
  constexpr float half_ulp = 0x1p-24f;
  const float coordinates = std::abs(position.x) + std::abs(position.y) + std::abs(position.z);
  return factor * half_ulp * (coordinates + glm::distance(position, eye));
}

}  // namespace shadewright
