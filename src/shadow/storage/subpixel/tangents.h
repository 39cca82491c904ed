// The tangents of a shadow's border by the pattern of occluded texels around it (SPSM section 4.2, figures 7 and 8).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace shadewright::shadow {

/// What a pattern says of the middle texel.
struct TangentPattern {
  enum class Kind { lit, shadowed, border } kind = Kind::lit;
  std::vector<glm::dvec2>
      normals;  ///< of a border, one a tangent, unit, into the shadow: shadowed if behind all of them
};

/// Bit (y + 1) * 3 + (x + 1) of `pattern` < 512: the neighbour at (x, y) is occluded.
TangentPattern tangent_pattern(uint32_t pattern);

}  // namespace shadewright::shadow
