#include "shadow/parameterization/uniform/uniform.h"

#include <algorithm>

namespace shadewright::shadow {

Uniform::Uniform(const gpu::Device& device, uint32_t resolution, std::string_view fit, const FilterReach& reach)
    : fit_(fit), resolution_(resolution), reach_(reach) {
  if (fit_ == "visible") visible_.emplace(device);
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
      lights.push_back(turn_to_fit(light, points));
      receivers.push_back(receiver_bounds(lights.back(), points));
    }
  });
  if (visible_) {
    const std::vector<Box> visible = visible_->measure(frame, recorder, lights);
    std::transform(receivers.begin(), receivers.end(), visible.begin(), receivers.begin(), intersect);
  }
  const FilterReach reach = lights.size() > 1 ? within_map(of_face(reach_), resolution_) : reach_;
  for (uint32_t layer = 0; layer < lights.size(); ++layer) {
    MapView view = fit_view(lights[layer], receivers[layer], resolution_, reach);
    view.layer = layer;
    if (view.drawn)
      view.casters = caster_planes(view, frame.camera, frame.light, fit_ != "scene",
                                   reach_on_receivers(lights[layer], receivers[layer], resolution_, reach));
    views_.push_back(std::move(view));
  }
}

Counters Uniform::counters() const {
  const auto drawn = std::count_if(views_.begin(), views_.end(), [](const MapView& view) { return view.drawn; });
  const auto resolution = static_cast<double>(resolution_);
  return {{"effective_resolution", {resolution, resolution}}, {"views", {static_cast<double>(drawn)}}};
}

std::vector<Allocation> Uniform::allocations() const {
  return visible_ ? visible_->allocations() : std::vector<Allocation>{};
}

}  // namespace shadewright::shadow
