#include "shadow/parameterization/rectilinear/rectilinear.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "shaders/collapse_comp.h"
#include "shaders/forward_comp.h"
#include "shaders/importance_comp.h"
#include "shaders/orient_comp.h"
#include "shaders/unwarp_comp.h"
#include "shaders/warp_comp.h"
#include "shadewright/error.h"
#include "shadow/parameterization/rectilinear/shared.h"
#include "shadow/parameterization/rectilinear/warped_caster_draws.h"

namespace shadewright::shadow {

namespace {

/// One pixel of a tile of that size adds to the sums (see importance.comp).
constexpr uint32_t tile_pixels = 4;
/// Where nothing is near a shadow's edge (the paper's alpha).
constexpr float weight_without_edge = 0.001f;

/// Coordinates in which a light's image plane is turned: metres across a directional light, tangents of others.
glm::dvec2 plane_coordinates(const LightFrame& light, const glm::dvec3& point, double nearest) {
  const glm::dvec3 p(light.view_from_world * glm::dvec4(point, 1.0));
  return light.perspective ? glm::dvec2(p) / std::max(-p.z, nearest) : glm::dvec2(p);
}

/// The map's coordinates from the plane's: an affine map.
struct PlaneMap {
  glm::dmat2 linear{1.0};
  glm::dvec2 origin{0.0};
};
PlaneMap map_from_plane(const LightFrame& light, const MapView& view) {
  const glm::dmat4 clip_from_view = view.light_from_world * glm::inverse(light.view_from_world);
  const auto map = [&](double x, double y) {
    const glm::dvec4 q = clip_from_view * glm::dvec4(x, y, -1, 1);
    return glm::dvec2(q) / q.w * 0.5 + 0.5;
  };
  const glm::dvec2 origin = map(0, 0);
  return {{map(1, 0) - origin, map(0, 1) - origin}, origin};
}

/// The light's image plane turned by `angle`, with all of `points` (its coordinates) in [0, 1].
shared::Orientation orientation(double angle, std::span<const glm::dvec2> points, const PlaneMap& map) {
  const glm::dvec2 axis(std::cos(angle), std::sin(angle));
  const glm::dmat2 turn(axis.x, -axis.y, axis.y, axis.x);
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::dvec2& point : points) {
    low = glm::min(low, turn * point);
    high = glm::max(high, turn * point);
  }
  const glm::dvec2 size = glm::max(high - low, 1e-9 * glm::max(glm::abs(low), glm::abs(high)) + 1e-12);
  const glm::dmat2 whole_from_map = glm::dmat2(1 / size.x, 0, 0, 1 / size.y) * turn * glm::inverse(map.linear);
  const glm::dvec2 at = -(whole_from_map * map.origin) - low / size;
  const glm::dmat2 rows = glm::transpose(whole_from_map);
  return {glm::vec3(rows[0], at.x), glm::vec3(rows[1], at.y), glm::vec2(low), glm::vec2(size)};
}

}  // namespace

Rectilinear::Rectilinear(const gpu::Device& device, const Spec& spec, const TechniqueOptions& options)
    : device_(device), spec_(spec), resolution_(spec.resolution), cells_(static_cast<uint32_t>(spec.number("cells"))) {
  using enum gpu::BindingKind;
  for (uint32_t slot = 0; slot < options.frames_in_flight; ++slot)
    constants_.emplace_back(device, "warp constants", sizeof(shared::WarpConstants), gpu::HostAccess::write);
  backward_ = spec.choice("analysis") != "forward";
  two_dimensional_ = spec.choice("map") == "2d";
  if (spec.choice("analysis") != "backward")
    light_image_.emplace(device, static_cast<uint32_t>(spec.number("image")), options.frames_in_flight);
  else if (spec.choice("se") == "on")
    throw InputError(spec.text, "backward analysis sees no shadow edges", "choose analysis=hybrid, or leave se out");
  if (WarpedCasterDraws::bends(spec) && spec.storage != "depth")
    throw InputError(spec.text,
                     fmt::format("tessellated casters write depth, not what storage '{}' keeps", spec.storage),
                     "leave tessellation out, or choose depth storage");
  const auto add = [&](const char* key, uint32_t function) {
    if (spec_.choice(key) == "on") functions_ |= function;
  };
  add("dv", shared::importance_view);
  add("de", shared::importance_distance);
  add("sn", shared::importance_normal);
  add("px", shared::importance_pixels);
  if (light_image_ && spec_.choice("se") != "off") functions_ |= shared::importance_edges;
  collapse_mode_ = spec_.choice("collapse") == "sum" ? shared::collapse_sum : shared::collapse_max;
  accumulated_ = gpu::Buffer(device, "importance", sizeof(shared::Importance));
  const uint64_t image_texels = light_image_ ? uint64_t{light_image_->size()} * light_image_->size() : 1;
  edges_ = gpu::Buffer(device, "shadow edges", image_texels * sizeof(uint32_t));
  importance_map_ = gpu::Buffer(device, "importance map",
                                two_dimensional_ ? uint64_t{cells_} * cells_ * sizeof(float) : sizeof(float));
  warp_ = gpu::Buffer(device, "warp", sizeof(shared::WarpData) + 2 * cells_ * sizeof(shared::WarpSegment));
  flats_ = gpu::Buffer(device, "unwarped texels", 2 * (2 * resolution_ + 1) * sizeof(float));
  history_ = gpu::Buffer(device, "warp history", sizeof(shared::WarpHistory));
  figures_ = gpu::Buffer(device, "warp figures", sizeof(shared::WarpFigures), gpu::HostAccess::read);
  collapse_ = gpu::ComputePass(device, shaders::collapse_comp, {uniform_buffer, storage_buffer, storage_buffer});
  build_ = gpu::ComputePass(device, shaders::warp_comp,
                            {uniform_buffer, storage_buffer, storage_buffer, storage_buffer, storage_buffer}, 0, {},
                            {0, functions_, collapse_mode_});
  unwarp_ = gpu::ComputePass(device, shaders::unwarp_comp, {storage_buffer, storage_buffer});
}

void Rectilinear::fit(const Frame& frame) {
  const LightFrame window = light_frames(frame.light).front();
  std::vector<Plane> planes = window_planes(window);
  const std::vector<Plane> camera = frame.camera.planes();
  planes.insert(planes.end(), camera.begin(), camera.end());
  const std::vector<glm::dvec3> points = receiver_points(frame, planes);
  const LightFrame light = turn_to_fit(window, points);
  const Box receivers = receiver_bounds(light, points);
  const FilterReach reach = within_map(filter_reach(spec_), resolution_);
  view_ = fit_view(light, receivers, resolution_, reach);
  if (view_.drawn)
    view_.casters = caster_planes(
        view_, frame.camera, frame.light, true,
        reach_on_receivers(light, receivers, resolution_, {widest_texel * (reach.texels + 1), reach.metres}));

  shared::WarpConstants& constants = constants_[slot(frame)].mapped<shared::WarpConstants>()[0];
  constants = {};
  std::vector<glm::dvec2> plane_points(points.size());
  std::transform(points.begin(), points.end(), plane_points.begin(),
                 [&](const glm::dvec3& point) { return plane_coordinates(light, point, -receivers.max.z); });
  if (plane_points.empty()) plane_points = {{0, 0}, {1, 1}};
  const PlaneMap map = view_.drawn ? map_from_plane(light, view_) : PlaneMap{};
  constants.orientation_count = spec_.choice("rotate") == "on" ? shared::max_orientations : 1;
  for (uint32_t i = 0; i < constants.orientation_count; ++i)
    constants.orientations[i] = orientation(0.5 * std::numbers::pi * i / shared::max_orientations, plane_points, map);

  constants.forward = backward_ ? 0 : 1;
  constants.image_size = light_image_ ? light_image_->size() : 1;
  constants.map_size = two_dimensional_ ? cells_ : 0;
  constants.normal_weight = static_cast<float>(spec_.number("beta"));
  constants.flat_weight = weight_without_edge;
  constants.cells = cells_;
  constants.sigma = static_cast<float>(std::max(spec_.number("sigma"), 1e-3));
  constants.temporal = static_cast<float>(spec_.number("temporal"));
  constants.history_holds = last_light_ && last_light_->kind == frame.light.kind &&
                            last_light_->direction == frame.light.direction &&
                            last_light_->position == frame.light.position;
  constants.resolution = resolution_;
  constants.longest_edge =
      WarpedCasterDraws::tessellates(spec_) ? std::stof(spec_.choice("tessellation")) / 100.0f : 1.0f;
  constants.max_segments = WarpedCasterDraws::bends(spec_) ? 0 : static_cast<uint32_t>(spec_.number("segments"));
  // No importance is above 1, so no sum can overflow.
  const double pixel_samples = (frame.camera.width / tile_pixels + 1.0) * (frame.camera.height / tile_pixels + 1.0);
  constants.sum_scale = static_cast<float>(4e9 / (backward_ ? pixel_samples : std::pow(constants.image_size, 2.0)));
  last_light_ = frame.light;
}

std::unique_ptr<CasterDraws> Rectilinear::make_caster_draws(LightKind, uint32_t frames_in_flight) {
  orient_ = {};  // the analyses are specialized for the light's kind
  return std::make_unique<WarpedCasterDraws>(frames_in_flight);
}

void Rectilinear::prepare(const Frame& frame, gpu::Recorder& recorder) {
  recorder.cpu_stage("fit", [&] {
    fit(frame);
    if (light_image_) light_image_->prepare(frame, slot(frame), view_);
  });
}

void Rectilinear::make_passes(const ReceiverLookup& receivers) {
  if (orient_) return;
  using enum gpu::BindingKind;
  std::vector<gpu::BindingKind> kinds = {uniform_buffer, sampled_image,  sampled_image, uniform_buffer,
                                         storage_buffer, storage_buffer, storage_buffer};
  const std::span sets(&receivers.layout, 1);
  const auto pass = [&](std::span<const uint32_t> spirv) {
    return gpu::ComputePass(device_, spirv, kinds, 0, sets,
                            {receivers.light_kind, functions_, collapse_mode_, two_dimensional_});
  };
  orient_ = pass(shaders::orient_comp);
  importance_ = pass(shaders::importance_comp);
  kinds.push_back(sampled_image);
  forward_ = pass(shaders::forward_comp);
}

void Rectilinear::record_analysis(const Frame& frame, const ReceiverLookup& receivers, gpu::Recorder& recorder) {
  using gpu::Binding;
  if (light_image_) light_image_->record(frame, slot(frame), receivers, recorder);
  const gpu::Buffer& constants = constants_[slot(frame)];
  const std::span sets(&receivers.set, 1);
  const auto bound = [&](const gpu::Buffer& own) {
    std::vector<Binding> result(receivers.receivers.begin(), receivers.receivers.end());
    result.push_back(Binding::uniform(constants));
    for (const gpu::Buffer* buffer : std::array<const gpu::Buffer*, 3>{&accumulated_, &own, &importance_map_})
      result.push_back(Binding::storage(*buffer));
    return result;
  };
  recorder.stage("importance", [&](const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(accumulated_.handle(), 0, VK_WHOLE_SIZE, 0);
    if (two_dimensional_) commands.fillBuffer(importance_map_.handle(), 0, VK_WHOLE_SIZE, 0);
    gpu::memory_barrier(commands);
    const uint32_t orientations = constants.mapped<shared::WarpConstants>()[0].orientation_count;
    if (orientations > 1) {
      orient_.dispatch(commands, bound(history_), {}, {orientations, 1, 1}, sets);
      gpu::memory_barrier(commands);
    }
    if (light_image_) {
      std::vector<Binding> with_image = bound(edges_);
      with_image.push_back(light_image_->binding());
      const uint32_t groups = gpu::groups(light_image_->size(), 8);
      forward_.dispatch(commands, with_image, {}, {groups, groups, 1}, sets);
      gpu::memory_barrier(commands);
    }
    if (backward_)
      importance_.dispatch(
          commands, bound(edges_), {},
          {gpu::groups(frame.camera.width, 8 * tile_pixels), gpu::groups(frame.camera.height, 8 * tile_pixels), 1},
          sets);
  });
}

void Rectilinear::record(const Frame& frame, const ReceiverLookup& receivers, gpu::Recorder& recorder) {
  using gpu::Binding;
  make_passes(receivers);
  record_analysis(frame, receivers, recorder);
  const gpu::Buffer& constants = constants_[slot(frame)];
  recorder.stage("warp", [&](const vk::raii::CommandBuffer& commands) {
    if (two_dimensional_) {
      const Binding collapse[] = {Binding::uniform(constants), Binding::storage(accumulated_),
                                  Binding::storage(importance_map_)};
      collapse_.dispatch(commands, collapse, {}, {gpu::groups(cells_, 64), 2, 1});
      gpu::memory_barrier(commands);
    }
    const Binding build[] = {Binding::uniform(constants), Binding::storage(accumulated_), Binding::storage(warp_),
                             Binding::storage(history_), Binding::storage(figures_)};
    build_.dispatch(commands, build, {}, {2, 1, 1});
    gpu::memory_barrier(commands);
    const Binding unwarp[] = {Binding::storage(warp_), Binding::storage(flats_)};
    unwarp_.dispatch(commands, unwarp, {}, {gpu::groups(resolution_, 64), 2, 1});
  });
}

std::vector<gpu::BindingKind> Rectilinear::lookup_kinds() const {
  using enum gpu::BindingKind;
  return {uniform_buffer, storage_buffer, storage_buffer};
}

std::vector<gpu::Binding> Rectilinear::lookup_bindings(uint32_t) const {
  using gpu::Binding;
  return {Binding::uniform(warp_, sizeof(shared::WarpHeader)), Binding::storage(warp_), Binding::storage(flats_)};
}

uint32_t Rectilinear::lookup_constant() const {
  const auto segments = static_cast<uint32_t>(spec_.number("segments"));
  return WarpedCasterDraws::bends(spec_) || segments > shared::few_segments ? 0 : segments;
}

Counters Rectilinear::counters() const {
  const shared::WarpFigures& figures = figures_.mapped<shared::WarpFigures>()[0];
  const auto finest = [&](int axis) { return std::ceil(resolution_ * static_cast<double>(figures.finest[axis])); };
  const double u = finest(0), v = finest(1);
  return {{"effective_resolution", {u, v}},
          {"matching_uniform_bytes", {4 * u * v}},
          {"matching_uniform_fits_16384", {std::max(u, v) <= 16384 ? 1.0 : 0.0}},
          {"expected_error_of_uniform",
           {static_cast<double>(figures.error_ratio[0]), static_cast<double>(figures.error_ratio[1])}},
          {"orientation_degrees", {90.0 * figures.orientation / shared::max_orientations}}};
}

std::vector<Allocation> Rectilinear::allocations() const {
  std::vector<Allocation> result;
  for (const gpu::Buffer* buffer : {&accumulated_, &edges_, &importance_map_, &warp_, &flats_, &history_, &figures_})
    result.push_back(buffer->allocation());
  for (const gpu::Buffer& buffer : constants_) result.push_back(buffer.allocation());
  if (light_image_)
    for (auto& allocation : light_image_->allocations()) result.push_back(std::move(allocation));
  return result;
}

Picture Rectilinear::debug_picture(std::string_view name, const ReceiverLookup&) {
  constexpr uint32_t size = 512;
  const auto bytes = gpu::read_back(device_, warp_, warp_.size());
  shared::WarpData warp;
  std::memcpy(&warp, bytes.data(), sizeof(warp));
  std::vector<shared::WarpSegment> segments(2 * cells_);
  std::memcpy(segments.data(), bytes.data() + sizeof(warp), segments.size() * sizeof(shared::WarpSegment));
  const auto segment = [&](uint32_t axis, uint32_t pixel) {
    return segments[axis * cells_ + warp.first_segments[axis * shared::max_cells + pixel * cells_ / size]];
  };
  Picture picture{size, size, std::vector<glm::u8vec4>(size * size, {0, 0, 0, 255})};
  const auto channel = [](double value) { return static_cast<uint8_t>(255.0 * std::clamp(value, 0.0, 1.0) + 0.5); };
  const auto at = [&](uint32_t axis, double flat) {
    const shared::WarpSegment s = segment(axis, std::min(size - 1, static_cast<uint32_t>(flat * size)));
    return s.start + s.slope * (flat - s.flat_start);
  };
  if (name == "grid") {
    // Every 32nd of the axes, where it lies in the map.
    std::vector<uint8_t> line(2 * size, 0);
    for (uint32_t axis = 0; axis < 2; ++axis)
      for (uint32_t k = 0; k < 32; ++k)
        line[axis * size + std::min(size - 1, static_cast<uint32_t>(at(axis, k / 32.0) * size))] = 1;
    for (uint32_t y = 0; y < size; ++y)
      for (uint32_t x = 0; x < size; ++x)
        if (line[x] || line[size + y]) picture.pixels[y * size + x] = {255, 255, 255, 255};
    return picture;
  }
  if (name == "warps") {
    // Red: moved towards the greater coordinate, blue: the other way; upper left half along u, lower right along v.
    for (uint32_t y = 0; y < size; ++y)
      for (uint32_t x = 0; x < size; ++x) {
        const uint32_t axis = x + y < size ? 0 : 1;
        const double flat = static_cast<double>(axis == 0 ? x : y) / size, moved = 4.0 * (at(axis, flat) - flat);
        picture.pixels[y * size + x] = {channel(moved), 0, channel(-moved), 255};
      }
    return picture;
  }
  if (two_dimensional_) {
    const auto map_bytes = gpu::read_back(device_, importance_map_, importance_map_.size());
    std::vector<float> map(size_t{cells_} * cells_);
    std::memcpy(map.data(), map_bytes.data(), map.size() * sizeof(float));
    const double greatest = std::max(1e-30, static_cast<double>(*std::max_element(map.begin(), map.end())));
    for (uint32_t y = 0; y < size; ++y)
      for (uint32_t x = 0; x < size; ++x) {
        const float value = map[size_t{y * cells_ / size} * cells_ + x * cells_ / size];
        const uint8_t grey = channel(std::pow(value / greatest, 1 / 2.2));
        picture.pixels[y * size + x] = value > 0 ? glm::u8vec4(grey, grey, grey, 255) : glm::u8vec4(0, 0, 64, 255);
      }
    return picture;
  }
  // The densities of columns and rows, brighter for more: their product, as the map's texels see it.
  double greatest[2] = {1e-30, 1e-30};
  for (uint32_t axis = 0; axis < 2; ++axis)
    for (uint32_t k = 0; k < warp.header.segment_counts[axis]; ++k)
      greatest[axis] = std::max(greatest[axis], static_cast<double>(segments[axis * cells_ + k].slope));
  for (uint32_t y = 0; y < size; ++y)
    for (uint32_t x = 0; x < size; ++x) {
      const double density = segment(0, x).slope / greatest[0] * segment(1, y).slope / greatest[1];
      const uint8_t grey = channel(std::pow(density, 1 / 2.2));
      picture.pixels[y * size + x] = {grey, grey, grey, 255};
    }
  return picture;
}

}  // namespace shadewright::shadow
