#include "shadow/parameterization/visible_bounds.h"

#include <bit>
#include <stdexcept>

#include "render/shared.h"
#include "shaders/visible_bounds_comp.h"
#include "shadow/parameterization/visible_bounds_shared.h"

namespace shadewright::shadow {

namespace {

double unordered(uint32_t ordered) {
  return static_cast<double>(std::bit_cast<float>((ordered & 0x80000000u) ? ordered & 0x7fffffffu : ~ordered));
}

/// Bounds of what was measured in floats hold the points themselves.
void widen(Box& box, const LightFrame& light, const Frame& frame) {
  if (box.empty()) return;
  const glm::dvec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
  const glm::dvec3 eye = glm::abs(frame.camera.eye());
  double error = position_slack * (eye.x + eye.y + eye.z);
  if (!light.perspective) {
    error += position_slack * (reach.x + reach.y + reach.z);
    box = {box.min - error, box.max + error};
    return;
  }
  const glm::dvec3 position = glm::abs(frame.light.position);
  error += position_slack * (position.x + position.y + position.z + reach.z);
  const glm::dvec3 slack(glm::dvec2(error / -box.max.z), error);
  box = {box.min - slack, {glm::dvec2(box.max) + glm::dvec2(slack), std::min(box.max.z + slack.z, 0.5 * box.max.z)}};
}

}  // namespace

VisibleBounds::VisibleBounds(const gpu::Device& device)
    : sampler_(gpu::make_sampler(device, vk::Filter::eNearest)),
      camera_(device, "fit camera", sizeof(shared::CameraData), gpu::HostAccess::write),
      sets_(device, "fit axes", shared::max_bounded_sets * sizeof(shared::BoundedSet), gpu::HostAccess::write),
      bounds_(device, "fit bounds", shared::max_bounded_sets * sizeof(shared::OrderedBounds), gpu::HostAccess::write) {
  using enum gpu::BindingKind;
  pass_ = gpu::ComputePass(device, shaders::visible_bounds_comp,
                           {uniform_buffer, sampled_image, storage_buffer, storage_buffer}, sizeof(uint32_t));
}

std::vector<Box> VisibleBounds::measure(const Frame& frame, gpu::Recorder& recorder, std::span<const LightFrame> lights,
                                        std::span<const DepthRange> depths) {
  if (lights.size() > shared::max_bounded_sets) throw std::logic_error("more sets of points than are bounded at once");
  camera_.mapped<shared::CameraData>()[0] = render::camera_data(frame.camera);
  const auto bounds = bounds_.mapped<shared::OrderedBounds>();
  for (size_t i = 0; i < lights.size(); ++i) {
    const DepthRange range = depths.empty() ? DepthRange{} : depths[i];
    sets_.mapped<shared::BoundedSet>()[i] = {glm::mat4x3(glm::mat4(lights[i].view_from_world)),
                                             static_cast<float>(lights[i].max_tangent),
                                             static_cast<float>(range.nearest), static_cast<float>(range.farthest)};
    bounds[i] = {{~0u, ~0u, ~0u}, {0, 0, 0}};
  }
  recorder.stage("fit visible", [&](const vk::raii::CommandBuffer& commands) {
    using gpu::Binding;
    const Binding bindings[] = {Binding::uniform(camera_), Binding::sampled(frame.depth, *sampler_),
                                Binding::storage(sets_), Binding::storage(bounds_)};
    const auto count = static_cast<uint32_t>(lights.size());
    pass_.dispatch(commands, bindings, gpu::bytes_of(count),
                   {gpu::groups(frame.camera.width, 8 * shared::bounded_tile),
                    gpu::groups(frame.camera.height, 8 * shared::bounded_tile), 1});
  });
  recorder.wait();
  std::vector<Box> result;
  for (size_t i = 0; i < lights.size(); ++i) {
    Box box;
    if (bounds[i].low[0] <= bounds[i].high[0])
      for (int axis = 0; axis < 3; ++axis) {
        box.min[axis] = unordered(bounds[i].low[axis]);
        box.max[axis] = unordered(bounds[i].high[axis]);
      }
    widen(box, lights[i], frame);
    result.push_back(box);
  }
  return result;
}

}  // namespace shadewright::shadow
