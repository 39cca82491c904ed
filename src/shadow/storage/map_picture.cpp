#include "shadow/storage/map_picture.h"

#include <cstring>

#include "shadewright/render/image.h"

namespace shadewright::shadow {

std::vector<float> map_values(const gpu::Device& device, gpu::Image& map, uint32_t texel_bytes,
                              const CasterDraws& draws, float empty) {
  const gpu::ImageDesc& desc = map.desc();
  const size_t texels = size_t{desc.width} * desc.height;
  std::vector<float> values(texels * desc.layers, empty);
  for (uint32_t layer = 0; layer < desc.layers; ++layer) {
    if (!draws.holds(layer)) continue;
    const auto bytes = gpu::read_back(device, map, texel_bytes, layer);
    for (size_t i = 0; i < texels; ++i)
      std::memcpy(&values[layer * texels + i], &bytes[i * texel_bytes], sizeof(float));
  }
  gpu::submit_and_wait(
      device, [&](const auto& commands) { map.transition(commands, vk::ImageLayout::eShaderReadOnlyOptimal); });
  return values;
}

Picture depth_picture(const gpu::Device& device, gpu::Image& map, const CasterDraws& draws) {
  std::vector<float> brightness = map_values(device, map, sizeof(float), draws, 1.0f);
  for (float& depth : brightness) depth = depth == 1.0f ? 0.0f : 1.0f - 0.9f * depth;
  return render::to_picture(brightness, map.desc().width, map.desc().height * map.desc().layers);
}

}  // namespace shadewright::shadow
