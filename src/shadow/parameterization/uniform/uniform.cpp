#include "shadow/parameterization/uniform/uniform.h"

#include <algorithm>
#include <bit>

#include "render/shared.h"
#include "shaders/reduce_comp.h"
#include "shadow/parameterization/uniform/reduce.h"

namespace shadewright::shadow {

namespace {

/// Faces of a point light overlap by the widest filter, so that a tap never leaves its face.
constexpr double filter_border_texels = 20;
/// Receivers' bounds are exact up to float rounding of the map coordinates.
constexpr double rounding_border_texels = 1;

double unordered(uint32_t ordered) {
  return static_cast<double>(std::bit_cast<float>((ordered & 0x80000000u) ? ordered & 0x7fffffffu : ~ordered));
}

}  // namespace

Uniform::Uniform(const gpu::Device& device, uint32_t resolution, std::string_view fit)
    : device_(device), fit_(fit), resolution_(resolution) {
  if (fit_ != "visible") return;
  using enum gpu::BindingKind;
  reduce_ =
      gpu::ComputePass(device, shaders::reduce_comp, {uniform_buffer, sampled_image, storage_buffer, storage_buffer});
  sampler_ = gpu::make_sampler(device, vk::Filter::eNearest);
  camera_ = gpu::Buffer(device, "fit camera", sizeof(shared::CameraData), gpu::HostAccess::write);
  light_axes_ = gpu::Buffer(device, "fit axes", 6 * sizeof(shared::LightAxes), gpu::HostAccess::write);
  bounds_ = gpu::Buffer(device, "fit bounds", 6 * sizeof(shared::OrderedBounds), gpu::HostAccess::write);
}

void Uniform::prepare(const Frame& frame, gpu::Recorder& recorder) {
  views_.clear();
  std::vector<LightFrame> lights;
  std::vector<Box> receivers;
  recorder.cpu_stage("fit", [&] {
    for (const LightFrame& light : light_frames(frame.light)) {
      std::vector<Plane> planes = window_planes(light);
      const std::vector<Plane> camera = fit_ == "scene" ? std::vector<Plane>{} : frame.camera.planes();
      planes.insert(planes.end(), camera.begin(), camera.end());
      const std::vector<glm::dvec3> points = receiver_points(frame, planes);
      lights.push_back(light.perspective ? light : turn_to_fit(light, points));
      receivers.push_back(receiver_bounds(lights.back(), points));
    }
  });
  if (fit_ == "visible") {
    const std::vector<Box> visible = visible_bounds(frame, recorder, lights);
    std::transform(receivers.begin(), receivers.end(), visible.begin(), receivers.begin(), intersect);
  }
  const double border = rounding_border_texels + (lights.size() > 1 ? filter_border_texels : 0.0);
  for (uint32_t layer = 0; layer < lights.size(); ++layer) {
    MapView view = fit_view(lights[layer], receivers[layer], resolution_, border);
    view.layer = layer;
    if (view.drawn) view.casters = caster_planes(view, frame.camera, frame.light, fit_ != "scene");
    views_.push_back(std::move(view));
  }
}

std::vector<Box> Uniform::visible_bounds(const Frame& frame, gpu::Recorder& recorder,
                                         std::span<const LightFrame> lights) {
  camera_.mapped<shared::CameraData>()[0] = render::camera_data(frame.camera);
  const auto bounds = bounds_.mapped<shared::OrderedBounds>();
  for (size_t i = 0; i < lights.size(); ++i) {
    light_axes_.mapped<shared::LightAxes>()[i] = {glm::mat4x3(glm::mat4(lights[i].view_from_world)),
                                                  static_cast<float>(lights[i].max_tangent)};
    bounds[i] = {{~0u, ~0u, ~0u}, {0, 0, 0}};
  }
  recorder.stage("fit visible", [&](const vk::raii::CommandBuffer& commands) {
    using gpu::Binding;
    const Binding bindings[] = {Binding::uniform(camera_), Binding::sampled(frame.depth, *sampler_),
                                Binding::storage(light_axes_), Binding::storage(bounds_)};
    reduce_.dispatch(commands, bindings, {},
                     {gpu::groups(frame.camera.width, 8), gpu::groups(frame.camera.height, 8),
                      static_cast<uint32_t>(lights.size())});
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
    result.push_back(box);
  }
  return result;
}

Counters Uniform::counters() const {
  const auto drawn = std::count_if(views_.begin(), views_.end(), [](const MapView& view) { return view.drawn; });
  const auto resolution = static_cast<double>(resolution_);
  return {{"effective_resolution", {resolution, resolution}}, {"views", {static_cast<double>(drawn)}}};
}

std::vector<Allocation> Uniform::allocations() const {
  if (fit_ != "visible") return {};
  return {camera_.allocation(), light_axes_.allocation(), bounds_.allocation()};
}

}  // namespace shadewright::shadow
