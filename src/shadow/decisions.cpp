#include "shadow/decisions.h"

#include <algorithm>
#include <array>

#include "shadow/storage/subpixel/shared.h"

namespace shadewright::shadow {

Counters decision_counters(std::span<const uint32_t> decisions, std::span<const std::string> names) {
  Counters counters;
  for (uint32_t i = 0; i < names.size(); ++i)
    counters[names[i]] = {static_cast<double>(
        std::ranges::count_if(decisions, [&](uint32_t decision) { return decision % shared::decided_lit == i + 1; }))};
  return counters;
}

Picture decisions_picture(std::span<const uint32_t> decisions, uint32_t width, uint32_t height) {
  constexpr std::array<glm::u8vec4, 4> shadowed{
      {{20, 20, 20, 255}, {70, 70, 70, 255}, {20, 110, 30, 255}, {150, 20, 20, 255}}};
  constexpr std::array<glm::u8vec4, 4> lit{
      {{20, 20, 20, 255}, {200, 200, 200, 255}, {110, 220, 120, 255}, {255, 110, 100, 255}}};
  Picture picture{width, height, {}};
  for (const uint32_t decision : decisions)
    picture.pixels.push_back(decision >= shared::decided_lit ? lit[decision - shared::decided_lit]
                                                             : shadowed[decision]);
  return picture;
}

}  // namespace shadewright::shadow
