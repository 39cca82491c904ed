// A visibility image's bytes (R8, 1 = lit) as the metrics take them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace shadewright::compare {

inline std::vector<float> visibility_floats(std::span<const std::byte> bytes) {
  std::vector<float> values(bytes.size());
  std::ranges::transform(bytes, values.begin(),
                         [](std::byte b) { return static_cast<float>(std::to_integer<uint8_t>(b)) / 255.0f; });
  return values;
}

}  // namespace shadewright::compare
