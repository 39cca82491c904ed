#include "shadow/view_caster_draws.h"

#include <algorithm>

#include "shadow/lookup_shaders.h"

namespace shadewright::shadow {

namespace {

/// What a view that draws nothing lets through.
const Plane nothing{{0, 0, 0}, -1};

}  // namespace

gpu::GraphicsDesc ViewCasterDraws::describe(const CasterPipelineDesc& desc) {
  gpu::GraphicsDesc pipeline = casters_shaders(desc.spec);
  render::CulledDraws::set_vertex_input(pipeline, desc.inputs);
  if (desc.sides) pipeline.kinds.assign(2, gpu::BindingKind::storage_buffer);
  pipeline.sets = {desc.lookup_layout};
  pipeline.push_bytes = sizeof(uint32_t);
  pipeline.depth_clamp = true;
  pipeline.colors = desc.colors;
  return pipeline;
}

void ViewCasterDraws::make_pipelines(const gpu::Device& device, const CasterPipelineDesc& desc) {
  pass_ = gpu::GraphicsPass(device, describe(desc));
  ask_for_sides(desc);
}

void ViewCasterDraws::ask_for_sides(const CasterPipelineDesc& desc) {
  if (desc.sides) sides_desc_.emplace(desc);
}

void ViewCasterDraws::make_draws(const render::SceneGpu& scene) {
  scene.device().handle().waitIdle();  // earlier frames may still draw the old scene
  scene_ = {};
  small_.reset();
  sides_.reset();
  draws_.emplace(scene, max_views_, frames_in_flight_, "shadow");
  if (sides_desc_) {
    const bool splits = compacts() && SmallCasters::serves(scene, sides_desc_->extent);
    sides_.emplace(scene, compacts(), splits, sides_desc_->lookup_layout);
    if (splits) small_.emplace(scene, *sides_desc_);
  }
  scene_ = KnownScene(&scene);
}

void ViewCasterDraws::prepare(const Frame& frame, uint32_t slot, std::span<const MapView> views) {
  views_ = views;
  if (!frame.scene) return;
  if (scene_ != KnownScene(frame.scene)) make_draws(*frame.scene);
  std::vector<std::vector<Plane>> planes;
  std::transform(views.begin(), views.end(), std::back_inserter(planes),
                 [](const MapView& view) { return view.drawn ? view.casters : std::vector<Plane>{nothing}; });
  draws_->set_views(slot, planes, {}, frame.casters);
}

void ViewCasterDraws::cull(const Frame& frame, uint32_t slot, const ReceiverLookup&, gpu::Recorder& recorder) {
  if (frame.scene)
    recorder.stage("shadow cull", [&](const vk::raii::CommandBuffer& commands) { draws_->cull(commands, slot); });
}

void ViewCasterDraws::draw(const vk::raii::CommandBuffer& commands, const Frame& frame, uint32_t index,
                           vk::DescriptorSet lookup_set) const {
  const MapView& view = views_[index];
  const vk::Rect2D area = view.viewport;
  commands.setViewport(
      0, vk::Viewport(static_cast<float>(area.offset.x), static_cast<float>(area.offset.y),
                      static_cast<float>(area.extent.width), static_cast<float>(area.extent.height), 0, 1));
  commands.setScissor(0, area);
  if (frame.scene) draw_scene(commands, index, lookup_set);
  if (frame.draw_casters) frame.draw_casters({commands, index, view, lookup_set});
}

void ViewCasterDraws::before(const vk::raii::CommandBuffer& commands, const Frame& frame, uint32_t index,
                             vk::DescriptorSet lookup_set) const {
  if (!frame.scene || !sides_) return;
  sides_->find(commands, *draws_, index, frame.light.kind, lookup_set,
               small_ ? small_->lists() : std::vector<gpu::Binding>{});
  if (small_) small_->rasterize(commands, lookup_set);
}

std::vector<gpu::Binding> ViewCasterDraws::sides(const gpu::Buffer& visible) const {
  return sides_ ? sides_->bindings(visible) : std::vector<gpu::Binding>{};
}

void ViewCasterDraws::draw_scene(const vk::raii::CommandBuffer& commands, uint32_t index,
                                 vk::DescriptorSet lookup_set) const {
  if (small_) small_->draw(commands, index, lookup_set);
  pass_.bind(commands, sides(draws_->visible()), gpu::bytes_of(index), std::span(&lookup_set, 1));
  if (sides_ && sides_->compacts())
    sides_->draw(commands, *draws_);
  else
    draws_->draw(commands, index);
}

std::vector<Allocation> ViewCasterDraws::allocations() const {
  std::vector<Allocation> result = draws_ ? draws_->allocations() : std::vector<Allocation>{};
  if (sides_)
    for (Allocation& allocation : sides_->allocations()) result.push_back(std::move(allocation));
  if (small_)
    for (Allocation& allocation : small_->allocations()) result.push_back(std::move(allocation));
  return result;
}

}  // namespace shadewright::shadow
