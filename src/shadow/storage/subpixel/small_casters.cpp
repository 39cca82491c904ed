#include "shadow/storage/subpixel/small_casters.h"

#include <algorithm>
#include <array>

#include "shaders/small_casters_comp.h"
#include "shaders/small_casters_frag.h"
#include "shaders/small_casters_vert.h"
#include "shaders/small_clear_comp.h"
#include "shaders/small_tiles_comp.h"
#include "shadow/storage/subpixel/shared.h"

namespace shadewright::shadow {

namespace {

uint64_t triangle_bytes(const render::SceneGpu& scene) {
  return uint64_t{scene.listed_triangles()} * sizeof(shared::SmallTriangle);
}

uint64_t texel_bytes(const MapExtent& extent) {
  return uint64_t{extent.width} * extent.height * sizeof(uint64_t);
}

}  // namespace

bool SmallCasters::serves(const render::SceneGpu& scene, const MapExtent& extent) {
  return scene.device().has_wide_atomics() &&
         std::max(triangle_bytes(scene), texel_bytes(extent)) <= gpu::max_binding_bytes;
}

SmallCasters::SmallCasters(const render::SceneGpu& scene, const CasterPipelineDesc& desc) : scene_(scene) {
  using enum gpu::BindingKind;
  const gpu::Device& device = scene.device();
  const MapExtent& extent = desc.extent;
  size_ = {extent.width, extent.height};
  tile_count_ = gpu::groups(extent.width, shared::small_tile) * gpu::groups(extent.height, shared::small_tile);
  triangles_ = gpu::Buffer(device, "small casters", triangle_bytes(scene));
  lists_ = gpu::Buffer(device, "small caster lists", scene.list_capacity() * sizeof(shared::SmallList));
  kept_ = gpu::Buffer(device, "small casters of texels", texel_bytes(extent));
  marked_ = gpu::Buffer(device, "small caster marks", tile_count_ * sizeof(uint32_t));
  tiles_ = gpu::Buffer(device, "small caster tiles", sizeof(shared::SmallTiles) + tile_count_ * sizeof(uint32_t));
  gpu::submit_and_wait(device, [&](const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(kept_.handle(), 0, VK_WHOLE_SIZE, ~0u);
    commands.fillBuffer(marked_.handle(), 0, VK_WHOLE_SIZE, 0);
    commands.fillBuffer(tiles_.handle(), 0, VK_WHOLE_SIZE, 0);
  });
  const std::span sets(&desc.lookup_layout, 1);
  rasterize_ =
      gpu::ComputePass(device, shaders::small_casters_comp, std::vector(5, storage_buffer), sizeof(uint32_t), sets);
  clear_ = gpu::ComputePass(device, shaders::small_clear_comp, std::vector(3, storage_buffer), sizeof(glm::uvec2));
  list_tiles_ = gpu::ComputePass(device, shaders::small_tiles_comp, std::vector(2, storage_buffer), sizeof(uint32_t));
  gpu::GraphicsDesc pipeline;
  pipeline.vertex = shaders::small_casters_vert;
  pipeline.fragment = shaders::small_casters_frag;
  pipeline.kinds.assign(3, storage_buffer);
  pipeline.sets = {desc.lookup_layout};
  pipeline.push_bytes = sizeof(uint32_t);
  pipeline.colors = desc.colors;
  pass_ = gpu::GraphicsPass(device, pipeline);
}

std::vector<gpu::Binding> SmallCasters::lists() const {
  return {gpu::Binding::storage(triangles_), gpu::Binding::storage(lists_)};
}

void SmallCasters::rasterize(const vk::raii::CommandBuffer& commands, vk::DescriptorSet lookup_set) const {
  using gpu::Binding;
  const uint32_t places = scene_.list_capacity();
  clear_.dispatch(commands, std::array{Binding::storage(marked_), Binding::storage(tiles_), Binding::storage(kept_)},
                  gpu::bytes_of(size_), {256, 1, 1});
  gpu::memory_barrier(commands);
  commands.updateBuffer<shared::SmallTiles>(tiles_.handle(), 0, shared::SmallTiles{6, 0, 0, 0});
  gpu::memory_barrier(commands);
  const std::array bindings{Binding::storage(triangles_), Binding::storage(lists_), Binding::storage(kept_),
                            Binding::storage(kept_), Binding::storage(marked_)};
  rasterize_.dispatch(commands, bindings, gpu::bytes_of(places), {std::min(gpu::groups(places, 4), 65535u), 1, 1},
                      std::span(&lookup_set, 1));
  gpu::memory_barrier(commands);
  list_tiles_.dispatch(commands, std::array{Binding::storage(marked_), Binding::storage(tiles_)},
                       gpu::bytes_of(tile_count_), {gpu::groups(tile_count_, 64), 1, 1});
  gpu::memory_barrier(commands);
}

void SmallCasters::draw(const vk::raii::CommandBuffer& commands, uint32_t view, vk::DescriptorSet lookup_set) const {
  using gpu::Binding;
  pass_.bind(commands, std::array{Binding::storage(tiles_), Binding::storage(triangles_), Binding::storage(kept_)},
             gpu::bytes_of(view), std::span(&lookup_set, 1));
  commands.drawIndirect(tiles_.handle(), 0, 1, sizeof(shared::SmallTiles));
}

std::vector<Allocation> SmallCasters::allocations() const {
  return {triangles_.allocation(), lists_.allocation(), kept_.allocation(), marked_.allocation(), tiles_.allocation()};
}

}  // namespace shadewright::shadow
