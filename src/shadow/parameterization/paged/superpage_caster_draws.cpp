#include "shadow/parameterization/paged/superpage_caster_draws.h"

#include <algorithm>
#include <array>
#include <bit>

#include "render/shared.h"
#include "shaders/page_copy_frag.h"
#include "shaders/page_copy_vert.h"
#include "shaders/superpage_vert.h"
#include "shadewright/error.h"
#include "shadow/parameterization/paged/paged.h"

namespace shadewright::shadow {

namespace {

constexpr uint64_t max_batch = 16;
constexpr uint32_t least_batches = 16;

/// The part of a face's view that a superpage shows.
MapView superpage_view(const MapView& face, const Superpage& superpage, double level_texels) {
  const double scale = level_texels / shared::superpage_texels;
  const glm::dvec2 first = glm::dvec2(superpage.first_page * shared::page_texels) / double{shared::superpage_texels};
  glm::dmat4 crop(1.0);
  crop[0][0] = crop[1][1] = scale;
  crop[3][0] = scale - 2.0 * first.x - 1.0;
  crop[3][1] = scale - 2.0 * first.y - 1.0;
  MapView view;
  view.light_from_world = crop * face.light_from_world;
  return view;
}

}  // namespace

SuperpageCasterDraws::SuperpageCasterDraws(const gpu::Device& device, const Paged& paged, uint32_t frames_in_flight)
    : paged_(paged), frames_in_flight_(frames_in_flight), sampler_(gpu::make_sampler(device, vk::Filter::eNearest)) {
  using Usage = vk::ImageUsageFlagBits;
  superpage_ = std::make_unique<gpu::Image>(
      device, gpu::ImageDesc{"superpage", vk::Format::eD32Sfloat, shared::superpage_texels, shared::superpage_texels, 1,
                             Usage::eDepthStencilAttachment | Usage::eSampled});
}

void SuperpageCasterDraws::make_pipelines(const gpu::Device& device, const CasterPipelineDesc& desc) {
  using enum gpu::BindingKind;
  gpu::GraphicsDesc casters;
  casters.vertex = shaders::superpage_vert;
  render::CulledDraws::set_vertex_input(casters, desc.inputs);
  casters.sets = {desc.lookup_layout};
  casters.push_bytes = sizeof(shared::SuperpagePlace);
  casters.depth_clamp = true;
  casters_pass_ = gpu::GraphicsPass(device, casters);
  gpu::GraphicsDesc copy;
  copy.vertex = shaders::page_copy_vert;
  copy.fragment = shaders::page_copy_frag;
  copy.kinds = {storage_buffer, sampled_image};
  copy.sets = {desc.lookup_layout};
  copy.push_bytes = sizeof(shared::SuperpagePlace);
  copy.depth_compare = vk::CompareOp::eAlways;
  copy_pass_ = gpu::GraphicsPass(device, copy);
}

void SuperpageCasterDraws::prepare(const Frame& frame, uint32_t, std::span<const MapView>) {
  if (frame.draw_casters)
    throw InputError("draw=superpages", "a caller's own casters can't be drawn into superpages",
                     "hand them over as a scene, or choose another parameterization");
}

void SuperpageCasterDraws::reserve(const render::SceneGpu& scene, size_t superpages) {
  const bool known = scene_ == KnownScene(&scene);
  if (!known) {
    const uint64_t bytes_of_view = std::max<uint64_t>(1, scene.list_capacity() * sizeof(shared::VisibleInstance));
    batch_size_ = static_cast<uint32_t>(std::clamp<uint64_t>(gpu::max_binding_bytes / bytes_of_view, 1, max_batch));
  }
  const uint32_t batches = gpu::groups(static_cast<uint32_t>(superpages), batch_size_);
  if (known && batches <= batches_) return;
  scene_ = {};
  batches_ = std::max(std::bit_ceil(batches), least_batches);
  // The host has waited for the pages that it binned: no earlier frame draws any more.
  culled_.emplace(scene, batch_size_, frames_in_flight_ * batches_, "superpage");
  scene_ = KnownScene(&scene);
}

void SuperpageCasterDraws::cull(const Frame& frame, uint32_t slot, const ReceiverLookup&, gpu::Recorder& recorder) {
  slot_ = slot;
  const std::span<const Superpage> superpages = paged_.superpages();
  MapView pool;
  pool.viewport = vk::Rect2D({0, 0}, {paged_.pool_texels(), paged_.pool_texels()});
  targets_.assign(superpages.size(), pool);
  recorder.cpu_stage("superpage views", [&] {
    if (!frame.scene) return;
    reserve(*frame.scene, superpages.size());
    std::vector<std::vector<Plane>> planes;
    for (uint32_t first = 0, batch = 0; first < superpages.size(); first += batch_size_, ++batch) {
      planes.clear();
      for (const Superpage& superpage :
           superpages.subspan(first, std::min<size_t>(batch_size_, superpages.size() - first))) {
        const MapView view =
            superpage_view(paged_.views()[superpage.face], superpage, paged_.level_texels(superpage.level));
        planes.push_back(caster_planes(view, frame.camera, frame.light, false, {}));
      }
      culled_->set_views(cull_slot(batch), planes, {}, frame.casters);
    }
  });
  recorder.stage("shadow cull", [&](const vk::raii::CommandBuffer& commands) { paged_.record_results(commands); });
}

void SuperpageCasterDraws::before(const vk::raii::CommandBuffer& commands, const Frame& frame, uint32_t index,
                                  vk::DescriptorSet lookup_set) const {
  using Layout = vk::ImageLayout;
  if (frame.scene && index % batch_size_ == 0) {
    gpu::memory_barrier(commands);  // the last batch has been drawn
    culled_->cull(commands, cull_slot(index / batch_size_));
    gpu::memory_barrier(commands);
  }
  superpage_->transition(commands, Layout::eDepthAttachmentOptimal, true);
  const vk::RenderingAttachmentInfo depth(superpage_->view(), Layout::eDepthAttachmentOptimal, {}, {}, {},
                                          vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
                                          vk::ClearDepthStencilValue(1.0f, 0));
  vk::RenderingInfo rendering({}, {{0, 0}, superpage_->extent()}, 1);
  rendering.pDepthAttachment = &depth;
  commands.beginRendering(rendering);
  const auto side = static_cast<float>(shared::superpage_texels);
  commands.setViewport(0, vk::Viewport(0, 0, side, side, 0, 1));
  commands.setScissor(0, rendering.renderArea);
  if (frame.scene) {
    const shared::SuperpagePlace& place = paged_.superpages()[index];
    casters_pass_.bind(commands, {}, gpu::bytes_of(place), std::span(&lookup_set, 1));
    culled_->draw(commands, index % batch_size_);
  }
  commands.endRendering();
  superpage_->transition(commands, Layout::eShaderReadOnlyOptimal);
}

void SuperpageCasterDraws::draw(const vk::raii::CommandBuffer& commands, const Frame&, uint32_t index,
                                vk::DescriptorSet lookup_set) const {
  using gpu::Binding;
  const Superpage& superpage = paged_.superpages()[index];
  const auto side = static_cast<float>(paged_.pool_texels());
  commands.setViewport(0, vk::Viewport(0, 0, side, side, 0, 1));
  commands.setScissor(0, targets_[index].viewport);
  copy_pass_.bind(
      commands, std::array{Binding::storage(paged_.superpage_pages()), Binding::sampled(superpage_->view(), *sampler_)},
      gpu::bytes_of<shared::SuperpagePlace>(superpage), std::span(&lookup_set, 1));
  commands.draw(6 * superpage.page_count, 1, 6 * superpage.first, 0);
}

std::vector<Allocation> SuperpageCasterDraws::allocations() const {
  std::vector<Allocation> result{superpage_->allocation()};
  if (culled_)
    for (Allocation& allocation : culled_->allocations()) result.push_back(std::move(allocation));
  return result;
}

}  // namespace shadewright::shadow
