#include "shadow/storage/depth_picture.h"

#include <cstring>

#include "shadewright/render/image.h"

namespace shadewright::shadow {

Picture depth_picture(const gpu::Device& device, gpu::Image& map) {
  const gpu::ImageDesc& desc = map.desc();
  std::vector<float> brightness;
  for (uint32_t layer = 0; layer < desc.layers; ++layer) {
    const auto bytes = gpu::read_back(device, map, sizeof(float), layer);
    const size_t first = brightness.size();
    brightness.resize(first + bytes.size() / sizeof(float));
    std::memcpy(&brightness[first], bytes.data(), bytes.size());
  }
  gpu::submit_and_wait(
      device, [&](const auto& commands) { map.transition(commands, vk::ImageLayout::eShaderReadOnlyOptimal); });
  for (float& depth : brightness) depth = depth == 1.0f ? 0.0f : 1.0f - 0.9f * depth;
  return render::to_picture(brightness, desc.width, desc.height * desc.layers);
}

}  // namespace shadewright::shadow
