#include "shadow/parameterization/paged/paged_caster_draws.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "shaders/page_bin_comp.h"
#include "shaders/page_bin_groups_comp.h"
#include "shaders/page_cull_comp.h"
#include "shaders/page_draw_comp.h"
#include "shadewright/error.h"
#include "shadow/lookup_shaders.h"
#include "shadow/parameterization/paged/paged.h"

namespace shadewright::shadow {

namespace {

// Pairs that a round has room for: a scene's triangles are mostly smaller than a page, and few levels overlap. A round
// that is not needed costs nearly nothing.
constexpr uint64_t pairs_per_triangle = 2, pairs_at_least = 1u << 18, pairs_at_most = 1u << 20;
constexpr uint32_t rounds = 8;
constexpr uint64_t max_buffer_bytes = 128u << 20;

}  // namespace

PagedCasterDraws::PagedCasterDraws(const gpu::Device& device, const Paged& paged, bool six_faces)
    : device_(device), paged_(paged), six_faces_(six_faces) {
  MapView pool;
  pool.viewport = vk::Rect2D({0, 0}, {paged.pool_texels(), paged.pool_texels()});
  rounds_.assign(rounds, pool);
}

void PagedCasterDraws::make_pipelines(const gpu::Device& device, const CasterPipelineDesc& desc) {
  gpu::GraphicsDesc pipeline = casters_shaders(desc.spec);
  pipeline.vertex_bindings = {{0, sizeof(shared::PageVertex), vk::VertexInputRate::eVertex}};
  pipeline.vertex_attributes = {{0, 0, vk::Format::eR32G32B32Sfloat, offsetof(shared::PageVertex, position)},
                                {1, 0, vk::Format::eR32Uint, offsetof(shared::PageVertex, slot)}};
  pipeline.sets = {desc.lookup_layout};
  pipeline.push_bytes = sizeof(uint32_t);
  pipeline.depth_clamp = true;
  pipeline.colors = desc.colors;
  draw_pass_ = gpu::GraphicsPass(device, pipeline);
  pipeline.depth_compare = vk::CompareOp::eAlways;
  clear_pass_ = gpu::GraphicsPass(device, pipeline);

  using enum gpu::BindingKind;
  const std::span layouts(&desc.lookup_layout, 1);
  const auto pass = [&](std::span<const uint32_t> spirv, size_t buffers,
                        std::span<const vk::DescriptorSetLayout> sets) {
    return gpu::ComputePass(device_, spirv, std::vector(buffers, storage_buffer), sizeof(constants_), sets, six_faces_);
  };
  cull_pass_ = pass(shaders::page_cull_comp, 6, layouts);
  groups_pass_ = pass(shaders::page_bin_groups_comp, 1, {});
  bin_pass_ = pass(shaders::page_bin_comp, 9, layouts);
  command_pass_ = pass(shaders::page_draw_comp, 1, {});
}

void PagedCasterDraws::prepare(const Frame& frame, uint32_t, std::span<const MapView>) {
  if (frame.draw_casters)
    throw InputError("paged", "a caller's own casters can't be cut into pages on the device",
                     "hand them over as a scene, or choose another parameterization");
  constants_.kinds = static_cast<uint32_t>(frame.casters);
  if (!frame.scene || scene_ == frame.scene) return;
  scene_ = frame.scene;
  const uint64_t faces = six_faces_ ? 6 : 1;
  const uint64_t clusters = std::min(scene_->list_capacity() * faces, max_buffer_bytes / sizeof(shared::PageCluster));
  const uint64_t pairs = std::clamp(scene_->triangle_count() * pairs_per_triangle, pairs_at_least, pairs_at_most);
  constants_ = {scene_->cluster_count(), static_cast<uint32_t>(clusters), static_cast<uint32_t>(3 * pairs), 0,
                static_cast<uint32_t>(frame.casters)};
  touched_ = gpu::Buffer(device_, "touched clusters", clusters * sizeof(shared::PageCluster));
  late_ = gpu::Buffer(device_, "late clusters", clusters * sizeof(shared::PageCluster));
  vertices_ = gpu::Buffer(device_, "triangle-page pairs", 3 * pairs * sizeof(shared::PageVertex));
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
  bin_pass_.dispatch_indirect(commands,
                              std::array{Binding::storage(scene.clusters()), Binding::storage(scene.instances()),
                                         Binding::storage(scene.positions()), Binding::storage(scene.indices()),
                                         Binding::storage(paged_.pages_to_draw()), Binding::storage(in),
                                         Binding::storage(out), state, Binding::storage(vertices_)},
                              push, paged_.state(), offsetof(shared::PageState, bin_groups), std::span(&lookup_set, 1));
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
  const auto corners = [&](const gpu::GraphicsPass& pass, const gpu::Buffer& vertices, size_t command) {
    pass.bind(commands, {}, gpu::bytes_of(index), std::span(&lookup_set, 1));
    commands.bindVertexBuffers(0, vertices.handle(), {0});
    commands.drawIndirect(paged_.state().handle(), command, 1, 0);
  };
  if (index == 0) corners(clear_pass_, paged_.clear_quads(), offsetof(shared::PageState, clear_vertex_count));
  if (frame.scene) corners(draw_pass_, vertices_, offsetof(shared::PageState, vertex_count));
}

std::vector<Allocation> PagedCasterDraws::allocations() const {
  if (!scene_) return {};
  return {touched_.allocation(), late_.allocation(), vertices_.allocation()};
}

}  // namespace shadewright::shadow
