#include "shadow/parameterization/rectilinear/warped_caster_draws.h"

#include <algorithm>
#include <cstddef>

#include "shaders/bent_geom.h"
#include "shaders/bent_tesc.h"
#include "shaders/bent_tese.h"
#include "shaders/bent_vert.h"
#include "shaders/cut_comp.h"
#include "shaders/split_comp.h"
#include "shadow/lookup_shaders.h"
#include "shadow/parameterization/rectilinear/shared.h"

namespace shadewright::shadow {

namespace {

constexpr uint32_t first_spare = 1u << 15;  ///< room for pieces to begin with

/// What cut_vertex.glsl reads besides the scene's vertex inputs.
void add_piece_inputs(gpu::GraphicsDesc& desc) {
  desc.vertex_bindings.push_back({2, sizeof(shared::PieceSegments), vk::VertexInputRate::eInstance});
  desc.vertex_attributes.push_back({6, 2, vk::Format::eR32G32B32A32Sfloat, offsetof(shared::PieceSegments, u)});
  desc.vertex_attributes.push_back({7, 2, vk::Format::eR32G32B32A32Sfloat, offsetof(shared::PieceSegments, v)});
}

/// Draws of the rest, of each cluster.
uint32_t rest_per_cluster(bool bends) {
  return bends ? shared::bent_draws_per_cluster : 1;
}

}  // namespace

void WarpedCasterDraws::make_pipelines(const gpu::Device& device, const CasterPipelineDesc& desc) {
  device_ = &device;
  ask_for_sides(desc);
  bends_ = bends(desc.spec);
  using enum gpu::BindingKind;
  part_ =
      gpu::ComputePass(device, bends_ ? std::span<const uint32_t>(shaders::split_comp) : shaders::cut_comp,
                       std::vector(9, storage_buffer), sizeof(shared::CutConstants), std::span(&desc.lookup_layout, 1));
  const gpu::GraphicsDesc plain = describe(desc);
  const auto pass = [&](bool warps_vertices) {
    gpu::GraphicsDesc pieces = plain;
    add_piece_inputs(pieces);
    pieces.constants = {shared::light_any, 0, 0, 0, warps_vertices};  // see cut_vertex.glsl
    return gpu::GraphicsPass(device, pieces);
  };
  pass_ = pass(bends_);
  if (!bends_) {
    rest_pass_ = pass(true);
    return;
  }
  gpu::GraphicsDesc pipeline = plain;
  pipeline.vertex = shaders::bent_vert;
  if (tessellates(desc.spec)) {
    pipeline.tessellation_control = shaders::bent_tesc;
    pipeline.tessellation_evaluation = shaders::bent_tese;
  }
  pipeline.geometry = shaders::bent_geom;
  pipeline.fragment = bent_fragment_shader(desc.spec);
  rest_pass_ = gpu::GraphicsPass(device, pipeline);
}

void WarpedCasterDraws::make_buffers(uint32_t spare) {
  const uint64_t clusters = scene_->cluster_count();
  spare_ = spare;
  const uint64_t pieces = uint64_t{scene_->list_capacity()} + spare;
  pieces_ = gpu::Buffer(*device_, "shadow pieces", pieces * sizeof(shared::VisibleInstance));
  piece_segments_ = gpu::Buffer(*device_, "segments of shadow pieces", pieces * sizeof(shared::PieceSegments));
  piece_draws_ = gpu::Buffer(*device_, "shadow piece draws", clusters * sizeof(shared::DrawCommand));
  rest_draws_ = gpu::Buffer(*device_, "shadow draws of the rest",
                            clusters * rest_per_cluster(bends_) * sizeof(shared::DrawCommand));
  figures_ = gpu::Buffer(*device_, "shadow cut figures", sizeof(shared::CutFigures), gpu::HostAccess::read);
  std::ranges::fill(figures_.mapped<shared::CutFigures>(), shared::CutFigures{});
}

void WarpedCasterDraws::prepare(const Frame& frame, uint32_t slot, std::span<const MapView> views) {
  const KnownScene before = scene_;
  ViewCasterDraws::prepare(frame, slot, views);
  if (!frame.scene) return;
  const uint32_t asked = figures_ ? figures_.mapped<shared::CutFigures>()[0].pieces : 0;
  if (scene_ == before && asked <= spare_) return;
  device_->handle().waitIdle();  // earlier frames may still draw from the old store
  make_buffers(std::max(first_spare, asked + asked / 2));
}

void WarpedCasterDraws::cull(const Frame& frame, uint32_t slot, const ReceiverLookup& lookup, gpu::Recorder& recorder) {
  using gpu::Binding;
  if (!frame.scene) return;
  recorder.stage("shadow cull", [&](const vk::raii::CommandBuffer& commands) {
    draws_->cull(commands, slot);
    commands.fillBuffer(figures_.handle(), 0, VK_WHOLE_SIZE, 0);
    gpu::memory_barrier(commands);
    const shared::CutConstants constants{scene_->cluster_count(), scene_->list_capacity(), spare_};
    const Binding bindings[] = {Binding::storage(scene_->clusters()), Binding::storage(draws_->order(slot)),
                                Binding::storage(draws_->commands()), Binding::storage(draws_->visible()),
                                Binding::storage(piece_draws_),       Binding::storage(pieces_),
                                Binding::storage(rest_draws_),        Binding::storage(figures_),
                                Binding::storage(piece_segments_)};
    part_.dispatch(commands, bindings, gpu::bytes_of(constants), {gpu::groups(constants.cluster_count, 64), 1, 1},
                   std::span(&lookup.set, 1));
  });
}

void WarpedCasterDraws::draw_scene(const vk::raii::CommandBuffer& commands, uint32_t index,
                                   vk::DescriptorSet lookup_set) const {
  commands.bindVertexBuffers(0, {scene_->positions().handle(), pieces_.handle(), piece_segments_.handle()}, {0, 0, 0});
  commands.bindIndexBuffer(scene_->indices().handle(), 0, vk::IndexType::eUint32);
  const auto draw = [&](const gpu::GraphicsPass& pass, const gpu::Buffer& draws, uint32_t per_cluster) {
    pass.bind(commands, sides(pieces_), gpu::bytes_of(index), std::span(&lookup_set, 1));
    commands.drawIndexedIndirect(draws.handle(), 0, per_cluster * scene_->cluster_count(), sizeof(shared::DrawCommand));
  };
  draw(pass_, piece_draws_, 1);
  draw(rest_pass_, rest_draws_, rest_per_cluster(bends_));
}

Counters WarpedCasterDraws::counters() const {
  if (bends_ || !figures_) return {};
  const shared::CutFigures& figures = figures_.mapped<shared::CutFigures>()[0];
  return {{"cut_pieces", {static_cast<double>(figures.pieces)}},
          {"uncut_clusters", {static_cast<double>(figures.uncut)}}};
}

std::vector<Allocation> WarpedCasterDraws::allocations() const {
  std::vector<Allocation> result = ViewCasterDraws::allocations();
  if (figures_)
    for (const gpu::Buffer* buffer : {&pieces_, &piece_segments_, &piece_draws_, &rest_draws_, &figures_})
      result.push_back(buffer->allocation());
  return result;
}

}  // namespace shadewright::shadow
