#include "shadow/parameterization/cascaded/cascaded.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>

#include "shaders/show_cascades_comp.h"
#include "shadow/lookup_data.h"
#include "shadow/receiver_words.h"
#include "shadow/shared.h"

namespace shadewright::shadow {

namespace {

static_assert(shared::max_cascades <= shared::max_map_views);

/// A stable window, and the range that is split, are chosen so many times as large as what they must hold along each
/// axis, and kept while they hold it and are at most so many times as large (area, ratio) as new ones.
constexpr double steady_slack = 1.03, steady_waste = 1.3;

/// Axes whose z is the camera's view depth.
LightFrame depth_axis(const render::CameraView& camera) {
  LightFrame frame;
  frame.view_from_world = glm::row(frame.view_from_world, 2, glm::row(camera.clip_from_world, 3));
  return frame;
}

Box window(const glm::dvec2& center, const glm::dvec2& half) {
  return {glm::dvec3(center - half, 0), glm::dvec3(center + half, 0)};
}

}  // namespace

Cascaded::Cascaded(const gpu::Device& device, const Spec& spec, uint32_t frames_in_flight)
    : device_(device),
      resolution_(spec.resolution),
      cascades_(static_cast<uint32_t>(spec.number("cascades"))),
      lambda_(spec.number("lambda")),
      stable_(spec.choice("stable") == "1"),
      reach_(filter_reach(spec)),
      steady_(cascades_) {
  if (spec.choice("splits") == "sdsm") visible_.emplace(device);
  for (uint32_t i = 0; i < frames_in_flight; ++i)
    constants_.emplace_back(device, "cascades", sizeof(shared::CascadeData), gpu::HostAccess::write);
}

Traits Cascaded::traits() const {
  return {.layered = true, .needs_readback = visible_.has_value(), .without_readback = "choose splits=pssm"};
}

void Cascaded::prepare(const Frame& frame, gpu::Recorder& recorder) {
  const LightFrame light = light_frames(frame.light).front();
  const std::vector<Plane> cone = window_planes(light);
  const auto receivers_in = [&](std::vector<Plane> planes) {
    planes.insert(planes.end(), cone.begin(), cone.end());
    return receiver_points(frame, planes);
  };
  Box all;
  DepthRange range;
  recorder.cpu_stage("fit", [&] {
    const std::vector<glm::dvec3> points = receivers_in(frame.camera.planes());
    all = receiver_bounds(light, points);
    range = view_depths(frame.camera, points);
  });
  if (visible_) {
    const LightFrame axis = depth_axis(frame.camera);
    const Box seen = visible_->measure(frame, recorder, std::span(&axis, 1)).front();
    range = {std::max(range.nearest, seen.min.z), std::min(range.farthest, seen.max.z)};
  }
  slices_.clear();
  if (range.nearest <= range.farthest) slices_ = split(stable_ ? steady_range(range) : range, cascades_, lambda_);
  slices_.resize(cascades_, {0, 0});
  // Rounding must not lose the nearest and the farthest point.
  std::vector<DepthRange> bounded = slices_;
  if (range.nearest <= range.farthest) {
    bounded.front().nearest = 0;
    bounded.back().farthest = std::numeric_limits<double>::infinity();
  }

  std::vector<LightFrame> lights(cascades_, light);
  std::vector<Box> receivers(cascades_);
  recorder.cpu_stage("fit", [&] {
    for (size_t i = 0; i < cascades_; ++i) {
      const std::vector<glm::dvec3> points = receivers_in(slice_planes(frame.camera, bounded[i]));
      lights[i] = turn_to_fit(light, points);
      receivers[i] = receiver_bounds(lights[i], points);
      if (stable_ && !receivers[i].empty()) hold_steady(steady_[i], light, points, lights[i], receivers[i]);
    }
  });
  if (visible_ && !stable_) {
    const std::vector<Box> visible = visible_->measure(frame, recorder, lights, bounded);
    std::transform(receivers.begin(), receivers.end(), visible.begin(), receivers.begin(), intersect);
  }

  views_.clear();
  borders_.assign(cascades_, glm::vec2(0));
  std::optional<glm::dvec4> depth_row;
  for (uint32_t i = 0; i < cascades_; ++i) {
    if (!receivers[i].empty()) {
      // One depth range for all cascades: a receiver may take any of them.
      receivers[i].min.z = all.min.z;
      receivers[i].max.z = all.max.z;
    }
    MapView view = make_view(lights[i], receivers[i], borders_[i]);
    view.layer = i;
    if (view.drawn) {
      // Receivers that are all equally deep are given a range by their window's size: the look-up needs the same for
      // all.
      if (!depth_row) depth_row = glm::row(view.light_from_world, 2);
      view.light_from_world = glm::row(view.light_from_world, 2, *depth_row);
      view.casters = caster_planes(view, frame.camera, frame.light, true,
                                   reach_on_receivers(lights[i], receivers[i], resolution_, reach_));
    }
    views_.push_back(std::move(view));
  }
  write_constants(light, constants_[frame.index % constants_.size()].mapped<shared::CascadeData>()[0]);
}

DepthRange Cascaded::steady_range(const DepthRange& range) {
  const auto ratio = [](const DepthRange& r) { return r.farthest / r.nearest; };
  const DepthRange fresh{range.nearest / steady_slack, range.farthest * steady_slack};
  const bool holds = steady_range_.nearest <= range.nearest && steady_range_.farthest >= range.farthest;
  if (!holds || ratio(steady_range_) > steady_waste * ratio(fresh)) steady_range_ = fresh;
  return steady_range_;
}

void Cascaded::hold_steady(SteadyWindow& steady, const LightFrame& light, std::span<const glm::dvec3> points,
                           LightFrame& turned, Box& receivers) {
  const auto half = [](const Box& box) { return 0.5 * glm::dvec2(box.size()); };
  const auto area = [](const glm::dvec2& size) { return size.x * size.y; };
  const SteadyWindow fresh{light, turned, steady_slack * half(receivers)};
  if (steady.turned_from.view_from_world == light.view_from_world &&
      area(steady.half) <= steady_waste * area(fresh.half)) {
    const Box again = receiver_bounds(steady.light, points);
    if (glm::all(glm::lessThanEqual(half(again), steady.half))) {
      turned = steady.light;
      receivers = window(glm::dvec2(again.center()), steady.half);
      return;
    }
  }
  steady = fresh;
  receivers = window(glm::dvec2(receivers.center()), steady.half);
}

MapView Cascaded::make_view(const LightFrame& light, Box receivers, glm::vec2& border) const {
  border = glm::vec2(0);
  if (receivers.empty()) return view_of_window(light, receivers, resolution_);
  const double resolution = resolution_;
  const double reach = seen_reach(light, -receivers.max.z, reach_.metres);
  // Snapping moves a stable window by half a texel.
  const glm::dvec2 half =
      window_half(light, receivers, resolution_, {reach_.texels + (stable_ ? 0.5 : 0.0), reach_.metres});
  glm::dvec2 center(receivers.center());
  if (stable_) {
    const glm::dvec2 texel = 2.0 * half / resolution;
    center = glm::round(center / texel) * texel;
  }
  for (int axis = 0; axis < 2; ++axis) {
    receivers.min[axis] = center[axis] - half[axis];
    receivers.max[axis] = center[axis] + half[axis];
    border[axis] = static_cast<float>(reach_.texels / resolution + (reach > 0 ? 0.5 * reach / half[axis] : 0.0));
  }
  return view_of_window(light, receivers, resolution_);
}

void Cascaded::write_constants(const LightFrame& light, shared::CascadeData& constants) const {
  constants.light_from_world = constants.world_from_light = glm::mat4(1);
  std::fill(std::begin(constants.windows), std::end(constants.windows),
            shared::CascadeWindow{glm::mat2(1), glm::vec2(0), glm::vec2(0.5)});
  const auto drawn = std::find_if(views_.begin(), views_.end(), [](const MapView& view) { return view.drawn; });
  if (drawn == views_.end()) return;
  glm::dmat4 light_from_world = light.view_from_world;
  for (const int row : {2, 3})
    light_from_world = glm::row(light_from_world, row, glm::row(drawn->light_from_world, row));
  const glm::dmat4 world_from_light = glm::inverse(light_from_world);
  constants.light_from_world = light_from_world;
  constants.world_from_light = world_from_light;
  for (size_t i = 0; i < views_.size(); ++i) {
    if (!views_[i].drawn) continue;
    const glm::dmat4 map_from_light = map_from_world(views_[i]) * world_from_light;
    constants.windows[i] = {glm::mat2(glm::mat4(map_from_light)), glm::vec2(map_from_light[3]), borders_[i]};
  }
}

Counters Cascaded::counters() const {
  const auto drawn = std::count_if(views_.begin(), views_.end(), [](const MapView& view) { return view.drawn; });
  const auto resolution = static_cast<double>(resolution_);
  std::vector<double> splits;
  for (const DepthRange& slice : slices_) splits.push_back(slice.nearest);
  if (!slices_.empty()) splits.push_back(slices_.back().farthest);
  return {{"effective_resolution", {resolution, resolution}},
          {"views", {static_cast<double>(drawn)}},
          {"splits", std::move(splits)}};
}

std::vector<Allocation> Cascaded::allocations() const {
  std::vector<Allocation> result = visible_ ? visible_->allocations() : std::vector<Allocation>{};
  for (const gpu::Buffer& buffer : constants_) result.push_back(buffer.allocation());
  return result;
}

Picture Cascaded::debug_picture(std::string_view, const ReceiverLookup& lookup) {
  constexpr std::array<glm::u8vec4, shared::max_cascades> colors{{{220, 60, 50, 255},
                                                                  {70, 180, 75, 255},
                                                                  {65, 100, 220, 255},
                                                                  {240, 200, 50, 255},
                                                                  {60, 200, 210, 255},
                                                                  {240, 140, 40, 255},
                                                                  {150, 90, 60, 255},
                                                                  {170, 170, 170, 255}}};
  const glm::u8vec4 none{255, 0, 255, 255}, background{20, 20, 20, 255};
  Picture picture{lookup.width, lookup.height, {}};
  for (const uint32_t cascade : receiver_words(device_, shaders::show_cascades_comp, lookup))
    picture.pixels.push_back(cascade < cascades_               ? colors[cascade]
                             : cascade == shared::max_cascades ? none
                                                               : background);
  return picture;
}

}  // namespace shadewright::shadow
