#include "shadow/caster_sides.h"

#include <array>

#include "render/shared.h"
#include "shaders/caster_sides_comp.h"
#include "shadow/shared.h"

namespace shadewright::shadow {

static_assert(shared::listed_alignment % shared::sides_per_word == 0, "a word holds sides of one instance");

CasterSides::CasterSides(const render::SceneGpu& scene, bool compacts, bool splits,
                         vk::DescriptorSetLayout lookup_layout)
    : scene_(scene) {
  const gpu::Device& device = scene.device();
  const uint64_t index_bytes = uint64_t{scene.listed_triangles()} * sizeof(glm::uvec3);
  sides_ = gpu::Buffer(device, "caster sides", scene.listed_triangles() / shared::sides_per_word * sizeof(uint32_t));
  if (compacts && index_bytes <= gpu::max_binding_bytes) {
    kept_indices_ = gpu::Buffer(device, "caster indices", index_bytes);
    kept_draws_ = gpu::Buffer(device, "caster draws", scene.list_capacity() * sizeof(shared::DrawCommand));
  }
  const auto pass = [&](uint32_t light_kind) {
    return gpu::ComputePass(device, shaders::caster_sides_comp, std::vector(13, gpu::BindingKind::storage_buffer),
                            sizeof(shared::SidesConstants), std::span(&lookup_layout, 1), {light_kind, splits});
  };
  directional_pass_ = pass(shared::light_directional);
  positional_pass_ = pass(shared::light_any);
}

void CasterSides::find(const vk::raii::CommandBuffer& commands, const render::CulledDraws& draws, uint32_t view,
                       LightKind light, vk::DescriptorSet lookup_set, std::vector<gpu::Binding> small_lists) const {
  using gpu::Binding;
  const shared::SidesConstants constants{scene_.cluster_count(), scene_.list_capacity(), view, compacts() ? 1u : 0u};
  std::vector bindings{Binding::storage(scene_.clusters()),
                       Binding::storage(scene_.listed_clusters()),
                       Binding::storage(draws.commands()),
                       Binding::storage(draws.visible()),
                       Binding::storage(scene_.indices()),
                       Binding::storage(scene_.fold_normals()),
                       Binding::storage(scene_.fold_offsets()),
                       Binding::storage(sides_),
                       Binding::storage(compacts() ? kept_indices_ : sides_),
                       Binding::storage(compacts() ? kept_draws_ : sides_),
                       Binding::storage(scene_.positions())};
  if (small_lists.empty()) small_lists.assign(2, Binding::storage(sides_));
  bindings.insert(bindings.end(), small_lists.begin(), small_lists.end());
  gpu::memory_barrier(commands);  // the view before may still be drawn
  commands.fillBuffer(sides_.handle(), 0, VK_WHOLE_SIZE, 0);
  gpu::memory_barrier(commands);
  const gpu::ComputePass& pass = light == LightKind::directional ? directional_pass_ : positional_pass_;
  pass.dispatch(commands, bindings, gpu::bytes_of(constants),
                {std::min(gpu::groups(constants.list_capacity, 4), 65535u), 1, 1}, std::span(&lookup_set, 1));
  gpu::memory_barrier(commands);
}

void CasterSides::draw(const vk::raii::CommandBuffer& commands, const render::CulledDraws& draws) const {
  commands.bindVertexBuffers(0, {scene_.positions().handle(), draws.visible().handle()}, {0, 0});
  commands.bindIndexBuffer(kept_indices_.handle(), 0, vk::IndexType::eUint32);
  commands.drawIndexedIndirect(kept_draws_.handle(), 0, scene_.list_capacity(), sizeof(shared::DrawCommand));
}

std::vector<gpu::Binding> CasterSides::bindings(const gpu::Buffer& visible) const {
  return {gpu::Binding::storage(sides_), gpu::Binding::storage(visible)};
}

std::vector<Allocation> CasterSides::allocations() const {
  std::vector<Allocation> result{sides_.allocation()};
  if (compacts()) result.insert(result.end(), {kept_indices_.allocation(), kept_draws_.allocation()});
  return result;
}

}  // namespace shadewright::shadow
