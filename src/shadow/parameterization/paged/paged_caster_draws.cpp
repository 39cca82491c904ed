#include "shadow/parameterization/paged/paged_caster_draws.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "shaders/page_bin_comp.h"
#include "shaders/page_bin_groups_comp.h"
#include "shaders/page_bin_sides_comp.h"
#include "shaders/page_clear_vert.h"
#include "shaders/page_clipped_casters_vert.h"
#include "shaders/page_cull_comp.h"
#include "shaders/page_draw_comp.h"
#include "shaders/page_inner_casters_vert.h"
#include "shaders/page_small_casters_vert.h"
#include "shaders/page_small_frag.h"
#include "shaders/page_whole_casters_vert.h"
#include "shadewright/error.h"
#include "shadow/lookup_data.h"
#include "shadow/lookup_shaders.h"
#include "shadow/parameterization/paged/paged.h"
#include "shadow/storage/subpixel/shared.h"

namespace shadewright::shadow {

namespace {

// What a round has room for. A scene's triangles are mostly smaller than a block of pages, and few levels overlap. A
// round that is not needed costs nearly nothing.
constexpr uint64_t pairs_per_triangle = 4, pairs_at_least = 1u << 18, pairs_at_most = 3u << 19;
constexpr uint64_t triangles_at_least = 1u << 16, triangles_at_most = 1u << 19;
constexpr uint32_t rounds = 8;

}  // namespace

PagedCasterDraws::PagedCasterDraws(const gpu::Device& device, const Paged& paged, LightKind light)
    : device_(device), paged_(paged), light_(light) {
  MapView pool;
  pool.viewport = vk::Rect2D({0, 0}, {paged.pool_texels(), paged.pool_texels()});
  rounds_.assign(rounds, pool);
}

void PagedCasterDraws::make_pipelines(const gpu::Device& device, const CasterPipelineDesc& desc) {
  using enum gpu::BindingKind;
  sides_ = desc.sides;
  gpu::GraphicsDesc pipeline;
  pipeline.sets = {desc.lookup_layout};
  pipeline.colors = desc.colors;
  gpu::GraphicsDesc clear = pipeline;
  clear.kinds = {storage_buffer};
  clear.vertex = shaders::page_clear_vert;
  clear.depth_compare = vk::CompareOp::eAlways;
  clear_pass_ = gpu::GraphicsPass(device, clear);

  pipeline.kinds = {storage_buffer, storage_buffer};
  pipeline.depth_clamp = true;
  pipeline.push_bytes = sizeof(uint32_t);
  if (sides_) {
    const gpu::GraphicsDesc stages = casters_shaders(desc.spec);
    pipeline.vertex = shaders::page_whole_casters_vert;
    pipeline.geometry = stages.geometry;
    pipeline.fragment = stages.fragment;
    passes_[shared::pair_inner] = gpu::GraphicsPass(device, pipeline);
    constants_.reach = shared::conservative_reach;
  } else {
    pipeline.vertex = shaders::page_clipped_casters_vert;
    passes_[shared::pair_clipped] = gpu::GraphicsPass(device, pipeline);
    pipeline.vertex = shaders::page_inner_casters_vert;
    passes_[shared::pair_inner] = gpu::GraphicsPass(device, pipeline);
    pipeline.vertex = shaders::page_small_casters_vert;
    pipeline.fragment = shaders::page_small_frag;
    passes_[shared::pair_small] = gpu::GraphicsPass(device, pipeline);
  }

  const std::span layouts(&desc.lookup_layout, 1);
  const auto pass = [&](std::span<const uint32_t> spirv, size_t buffers,
                        std::span<const vk::DescriptorSetLayout> sets) {
    return gpu::ComputePass(device_, spirv, std::vector(buffers, storage_buffer), sizeof(constants_), sets,
                            {shared_kind(light_)});
  };
  cull_pass_ = pass(shaders::page_cull_comp, 6, layouts);
  groups_pass_ = pass(shaders::page_bin_groups_comp, 1, {});
  bin_pass_ = sides_ ? pass(shaders::page_bin_sides_comp, 12, layouts) : pass(shaders::page_bin_comp, 10, layouts);
  command_pass_ = pass(shaders::page_draw_comp, 1, {});
}

void PagedCasterDraws::prepare(const Frame& frame, uint32_t, std::span<const MapView>) {
  if (frame.draw_casters)
    throw InputError("paged", "a caller's own casters can't be cut into pages on the device",
                     "hand them over as a scene, or choose another parameterization");
  constants_.kinds = static_cast<uint32_t>(frame.casters);
  if (frame.scene && scene_ != KnownScene(frame.scene)) make_buffers(*frame.scene);
}

void PagedCasterDraws::make_buffers(const render::SceneGpu& scene) {
  device_.handle().waitIdle();  // earlier frames may still draw the old scene
  scene_ = {};
  const uint64_t faces = light_ == LightKind::point ? 6 : 1;
  const uint64_t clusters =
      std::min(scene.list_capacity() * faces, gpu::max_binding_bytes / sizeof(shared::PageCluster));
  const uint64_t pairs = std::clamp(scene.triangle_count() * pairs_per_triangle, pairs_at_least, pairs_at_most);
  const uint64_t triangles = std::clamp(scene.triangle_count() * faces, triangles_at_least, triangles_at_most);
  constants_.cluster_count = scene.cluster_count();
  constants_.cluster_capacity = static_cast<uint32_t>(clusters);
  constants_.triangle_capacity = static_cast<uint32_t>(triangles);
  // Half of the pairs may be inner ones; of the others most are small.
  for (uint32_t kind = 0; kind <= shared::pair_kinds; ++kind)
    constants_.first_pair[kind] = static_cast<uint32_t>(pairs * std::array<uint64_t, 4>{0, 4, 7, 8}[kind] / 8);
  touched_ = gpu::Buffer(device_, "touched clusters", clusters * sizeof(shared::PageCluster));
  late_ = gpu::Buffer(device_, "late clusters", clusters * sizeof(shared::PageCluster));
  pairs_ = gpu::Buffer(device_, "triangle-page pairs", pairs * sizeof(glm::uvec3));
  corners_ = gpu::Buffer(device_, "triangles in the map", triangles * 3 * sizeof(glm::vec4));
  scene_ = KnownScene(&scene);
}

void PagedCasterDraws::cull(const Frame& frame, uint32_t, const ReceiverLookup& lookup, gpu::Recorder& recorder) {
  if (!frame.scene) return;
  using gpu::Binding;
  const render::SceneGpu& scene = *frame.scene;
  recorder.stage("shadow cull", [&](const vk::raii::CommandBuffer& commands) {
    cull_pass_.dispatch(
        commands,
        std::array{Binding::storage(scene.clusters()), Binding::storage(scene.instances()),
                   Binding::storage(paged_.pages_to_draw()), Binding::storage(paged_.pages_to_draw_or_finer()),
                   Binding::storage(paged_.state()), Binding::storage(touched_)},
        gpu::bytes_of(constants_), {gpu::groups(scene.cluster_count(), 64), 1, 1}, std::span(&lookup.set, 1));
    gpu::memory_barrier(commands);
    paged_.record_results(commands);
  });
  recorder.stage("page triangles",
                 [&](const vk::raii::CommandBuffer& commands) { bin(commands, frame, 0, lookup.set); });
}

void PagedCasterDraws::bin(const vk::raii::CommandBuffer& commands, const Frame& frame, uint32_t round,
                           vk::DescriptorSet lookup_set) const {
  using gpu::Binding;
  const render::SceneGpu& scene = *frame.scene;
  shared::BinConstants constants = constants_;
  constants.round = round;
  const auto push = gpu::bytes_of(constants);
  const Binding state = Binding::storage(paged_.state());
  const gpu::Buffer &in = round % 2 == 0 ? touched_ : late_, &out = round % 2 == 0 ? late_ : touched_;
  groups_pass_.dispatch(commands, std::array{state}, push, {1, 1, 1});
  gpu::memory_barrier(commands);
  const std::array bindings{Binding::storage(scene.clusters()),
                            Binding::storage(scene.instances()),
                            Binding::storage(scene.positions()),
                            Binding::storage(scene.indices()),
                            Binding::storage(paged_.pages_to_draw()),
                            Binding::storage(in),
                            Binding::storage(out),
                            state,
                            Binding::storage(pairs_),
                            Binding::storage(corners_),
                            Binding::storage(scene.fold_normals()),
                            Binding::storage(scene.fold_offsets())};
  bin_pass_.dispatch_indirect(commands, std::span(bindings).first(sides_ ? 12 : 10), push, paged_.state(),
                              offsetof(shared::PageState, bin_groups), std::span(&lookup_set, 1));
  gpu::memory_barrier(commands);
  command_pass_.dispatch(commands, std::array{state}, push, {1, 1, 1});
  gpu::memory_barrier(commands);
  if (round + 1 == rounds) paged_.record_results(commands);
}

void PagedCasterDraws::before(const vk::raii::CommandBuffer& commands, const Frame& frame, uint32_t index,
                              vk::DescriptorSet lookup_set) const {
  if (!frame.scene || index == 0) return;
  gpu::memory_barrier(commands);  // the last round's corners have been drawn
  bin(commands, frame, index, lookup_set);
}

void PagedCasterDraws::draw(const vk::raii::CommandBuffer& commands, const Frame& frame, uint32_t index,
                            vk::DescriptorSet lookup_set) const {
  const auto side = static_cast<float>(paged_.pool_texels());
  commands.setViewport(0, vk::Viewport(0, 0, side, side, 0, 1));
  commands.setScissor(0, rounds_[index].viewport);
  const auto draw_units = [&](const gpu::GraphicsPass& pass, std::span<const gpu::Binding> bindings,
                              std::span<const std::byte> push, size_t command) {
    pass.bind(commands, bindings, push, std::span(&lookup_set, 1));
    commands.drawIndirect(paged_.state().handle(), command, 1, 0);
  };
  using gpu::Binding;
  if (index == 0)
    draw_units(clear_pass_, std::array{Binding::storage(paged_.emptied())}, {}, offsetof(shared::PageState, clear));
  if (!frame.scene) return;
  const std::array bindings{Binding::storage(corners_), Binding::storage(pairs_)};
  for (uint32_t kind = 0; kind < shared::pair_kinds; ++kind)
    draw_units(passes_[sides_ ? shared::pair_inner : kind], bindings, gpu::bytes_of(kind),
               offsetof(shared::PageState, draws) + kind * sizeof(shared::DrawArrays));
}

std::vector<Allocation> PagedCasterDraws::allocations() const {
  if (!corners_) return {};
  return {touched_.allocation(), late_.allocation(), pairs_.allocation(), corners_.allocation()};
}

}  // namespace shadewright::shadow
