#include <algorithm>
#include <cstddef>
#include <numeric>
#include <stdexcept>

#include "render/shared.h"
#include "shaders/cull_comp.h"
#include "shadewright/render/scene_gpu.h"

namespace shadewright::render {

namespace {

shared::CullView cull_view(std::span<const Plane> planes, InstanceFilter filter) {
  if (planes.size() > shared::max_cull_planes) throw std::logic_error("a view has more planes than culling holds");
  shared::CullView view{};
  view.plane_count = static_cast<uint32_t>(planes.size());
  view.kinds = static_cast<uint32_t>(filter);
  for (size_t i = 0; i < planes.size(); ++i) view.planes[i] = glm::vec4(glm::dvec4(planes[i].normal, planes[i].offset));
  return view;
}

}  // namespace

CulledDraws::CulledDraws(const SceneGpu& scene, uint32_t max_views, uint32_t frames_in_flight, const std::string& name)
    : scene_(scene), max_views_(max_views), view_counts_(frames_in_flight, 0) {
  using enum gpu::BindingKind;
  const gpu::Device& device = scene.device();
  pass_ =
      gpu::ComputePass(device, shaders::cull_comp,
                       {storage_buffer, storage_buffer, storage_buffer, storage_buffer, storage_buffer, storage_buffer},
                       sizeof(shared::CullConstants));
  for (uint32_t slot = 0; slot < frames_in_flight; ++slot) {
    views_.emplace_back(device, name + " views", max_views * sizeof(shared::CullView), gpu::HostAccess::write);
    order_.emplace_back(device, name + " order", scene.cluster_count() * sizeof(uint32_t), gpu::HostAccess::write);
    const auto order = order_.back().mapped<uint32_t>();
    std::iota(order.begin(), order.end(), 0u);
  }
  draws_ =
      gpu::Buffer(device, name + " draws", uint64_t{max_views} * scene.cluster_count() * sizeof(shared::DrawCommand));
  visible_ = gpu::Buffer(device, name + " visible instances",
                         uint64_t{max_views} * scene.list_capacity() * sizeof(shared::VisibleInstance));
}

void CulledDraws::set_views(uint32_t slot, std::span<const std::vector<Plane>> views, std::span<const uint32_t> order,
                            InstanceFilter filter) {
  if (views.size() > max_views_) throw std::logic_error("more views than CulledDraws was made for");
  view_counts_[slot] = static_cast<uint32_t>(views.size());
  const auto mapped = views_[slot].mapped<shared::CullView>();
  std::transform(views.begin(), views.end(), mapped.begin(),
                 [&](const auto& planes) { return cull_view(planes, filter); });
  std::copy(order.begin(), order.end(), order_[slot].mapped<uint32_t>().begin());
}

void CulledDraws::cull(const vk::raii::CommandBuffer& commands, uint32_t slot) const {
  using gpu::Binding;
  const shared::CullConstants constants{scene_.cluster_count(), scene_.list_capacity()};
  const Binding bindings[] = {Binding::storage(scene_.clusters()),
                              Binding::storage(scene_.instances()),
                              Binding::storage(views_[slot]),
                              Binding::storage(order_[slot]),
                              Binding::storage(draws_),
                              Binding::storage(visible_)};
  pass_.dispatch(commands, bindings, gpu::bytes_of(constants),
                 {gpu::groups(scene_.cluster_count(), 64), view_counts_[slot], 1});
}

void CulledDraws::draw(const vk::raii::CommandBuffer& commands, uint32_t view) const {
  commands.bindVertexBuffers(0, {scene_.positions().handle(), visible_.handle()}, {0, 0});
  commands.bindIndexBuffer(scene_.indices().handle(), 0, vk::IndexType::eUint32);
  const uint64_t first = uint64_t{view} * scene_.cluster_count() * sizeof(shared::DrawCommand);
  commands.drawIndexedIndirect(draws_.handle(), first, scene_.cluster_count(), sizeof(shared::DrawCommand));
}

void CulledDraws::set_vertex_input(gpu::GraphicsDesc& desc, SceneInputs inputs) {
  using Format = vk::Format;
  desc.vertex_bindings = {{0, sizeof(glm::vec3), vk::VertexInputRate::eVertex},
                          {1, sizeof(shared::VisibleInstance), vk::VertexInputRate::eInstance}};
  desc.vertex_attributes = {{0, 0, Format::eR32G32B32Sfloat, 0}};
  for (uint32_t row = 0; row < 3; ++row)
    desc.vertex_attributes.push_back(
        {1 + row, 1, Format::eR32G32B32A32Sfloat, row * static_cast<uint32_t>(sizeof(glm::vec4))});
  desc.vertex_attributes.push_back({4, 1, Format::eR32Uint, offsetof(shared::VisibleInstance, first_triangle)});
  desc.vertex_attributes.push_back({5, 1, Format::eR8G8B8A8Unorm, offsetof(shared::VisibleInstance, albedo)});
  desc.vertex_attributes.resize(static_cast<size_t>(inputs));
}

std::vector<Allocation> CulledDraws::allocations() const {
  std::vector<Allocation> result{draws_.allocation(), visible_.allocation()};
  for (const auto& buffer : views_) result.push_back(buffer.allocation());
  for (const auto& buffer : order_) result.push_back(buffer.allocation());
  return result;
}

}  // namespace shadewright::render
