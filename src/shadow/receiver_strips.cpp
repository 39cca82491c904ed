#include "shadow/receiver_strips.h"

#include <algorithm>

namespace shadewright::shadow {

std::vector<shared::ReceiverStrip> receiver_strips(uint32_t width, uint32_t height, uint64_t most_pixels) {
  const uint64_t units = std::max<uint64_t>(1, most_pixels / (uint64_t{width} * strip_alignment));
  const auto rows = static_cast<uint32_t>(std::min<uint64_t>(height, units * strip_alignment));
  std::vector<shared::ReceiverStrip> strips;
  for (uint32_t first = 0; first < height; first += rows) strips.push_back({first, std::min(rows, height - first)});
  return strips;
}

}  // namespace shadewright::shadow
