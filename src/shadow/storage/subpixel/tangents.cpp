#include "shadow/storage/subpixel/tangents.h"

#include <array>

namespace shadewright::shadow {

namespace {

constexpr std::array<glm::ivec2, 8> ring{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

bool inside(const glm::ivec2& at) {
  return std::abs(at.x) <= 1 && std::abs(at.y) <= 1;
}
uint32_t bit(const glm::ivec2& at) {
  return 1u << ((at.y + 1) * 3 + at.x + 1);
}

/// Those of the occluded texels that are joined to the middle one by sides. Conservative rasterization marks every
/// texel that an occluder touches, so what only a corner joins is another occluder.
uint32_t joined_to_middle(uint32_t pattern) {
  uint32_t joined = bit({0, 0}) & pattern;
  for (uint32_t before = 0; before != joined;) {
    before = joined;
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)})
          if (const glm::ivec2 to = glm::ivec2(x, y) + step; (joined & bit({x, y})) && inside(to))
            joined |= bit(to) & pattern;
  }
  return joined;
}

}  // namespace

TangentPattern tangent_pattern(uint32_t pattern) {
  const uint32_t occluded = joined_to_middle(pattern);
  if (occluded == 0 || occluded == bit({0, 0})) return {};
  if (occluded == 511) return {TangentPattern::Kind::shadowed, {}};
  TangentPattern result{TangentPattern::Kind::border, {}};
  const auto lit = [&](size_t i) { return (occluded & bit(ring[i % 8])) == 0; };
  for (size_t begin = 0; begin < 8; ++begin) {
    if (!lit(begin) || lit(begin + 7)) continue;  // not the first of an arc
    glm::ivec2 sum(0);
    size_t count = 0;
    for (; lit(begin + count); ++count) sum += ring[(begin + count) % 8];
    const glm::dvec2 towards_light(sum == glm::ivec2(0) ? ring[(begin + count / 2) % 8] : sum);
    result.normals.push_back(-glm::normalize(towards_light));
  }
  return result;
}

}  // namespace shadewright::shadow
