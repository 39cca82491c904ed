#include "shadow/parameterization/perspective/perspective.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "render/shared.h"
#include "shaders/show_aliasing_comp.h"
#include "shaders/visible_comp.h"
#include "shadow/lookup_data.h"
#include "shadow/receiver_words.h"
#include "shadow/shared.h"

namespace shadewright::shadow {

namespace {

/// From blue, a texel of a sixteenth of a pixel, over white, one of a pixel, to red, sixteen pixels.
glm::u8vec4 aliasing_color(float size) {
  if (size == -1) return {20, 20, 20, 255};
  if (size < 0) return {110, 110, 110, 255};
  const float x = std::clamp(std::log2(std::max(size, 1e-6f)) / 4, -1.0f, 1.0f);
  const auto rest = static_cast<uint8_t>(std::lround(255 * (1 - std::abs(x))));
  return x < 0 ? glm::u8vec4(rest, rest, 255, 255) : glm::u8vec4(255, rest, rest, 255);
}

}  // namespace

Perspective::Perspective(const gpu::Device& device, uint32_t resolution, const PerspectiveOptions& options,
                         uint32_t width, uint32_t height)
    : device_(device),
      options_(options),
      resolution_(resolution),
      plain_(device, resolution, "view", options.reach),
      grid_(tile_grid(width, height)) {
  if (!options.from_buffers) return;
  sampler_ = gpu::make_sampler(device, vk::Filter::eNearest);
  camera_ = gpu::Buffer(device, "perspective camera", sizeof(shared::CameraData), gpu::HostAccess::write);
  tiles_ = gpu::Buffer(device, "visible tiles", grid_.columns * grid_.rows * sizeof(shared::VisibleTile),
                       gpu::HostAccess::read);
}

void Perspective::prepare(const Frame& frame, gpu::Recorder& recorder) {
  const Receivers receivers = find_receivers(frame, recorder);
  plain_.prepare(frame, recorder);
  recorder.cpu_stage("perspective", [&] { choose_views(frame, receivers); });
}

void Perspective::make_reduction(LightKind light) {
  if (reduces_for_ == light) return;
  device_.handle().waitIdle();  // an earlier frame may still use the old one
  using enum gpu::BindingKind;
  reduce_ =
      gpu::ComputePass(device_, shaders::visible_comp, {uniform_buffer, sampled_image, sampled_image, storage_buffer},
                       sizeof(shared::TileConstants), {}, {shared_kind(light)});
  reduces_for_ = light;
}

Receivers Perspective::find_receivers(const Frame& frame, gpu::Recorder& recorder) {
  Receivers receivers;
  if (!options_.from_buffers) {
    recorder.cpu_stage("receivers", [&] { receivers = bounded_receivers(frame); });
    return receivers;
  }
  make_reduction(frame.light.kind);
  camera_.mapped<shared::CameraData>()[0] = render::camera_data(frame.camera);
  const shared::TileConstants constants{grid_.side, glm::uvec2(grid_.columns, grid_.rows),
                                        static_cast<float>(std::cos(frame.light.outer_angle)),
                                        glm::vec3(frame.light.position), glm::vec3(frame.light.direction)};
  recorder.stage("visible depth", [&](const vk::raii::CommandBuffer& commands) {
    using gpu::Binding;
    const Binding bindings[] = {Binding::uniform(camera_), Binding::sampled(frame.depth, *sampler_),
                                Binding::sampled(frame.normal, *sampler_), Binding::storage(tiles_)};
    reduce_.dispatch(commands, bindings, gpu::bytes_of(constants),
                     {gpu::groups(grid_.columns, 8), gpu::groups(grid_.rows, 8), 1});
  });
  recorder.wait();
  recorder.cpu_stage("receivers", [&] {
    const auto tiles = tiles_.mapped<shared::VisibleTile>().first(size_t{grid_.columns} * grid_.rows);
    receivers = visible_receivers(frame.camera, tiles, grid_);
  });
  return receivers;
}

void Perspective::choose_views(const Frame& frame, const Receivers& receivers) {
  WarpOptions options{options_.warp,  options_.least_shift, resolution_,        options_.from_buffers, nullptr, {},
                      options_.reach, options_.soft,        options_.falls_back};
  std::vector<Box> casters;
  if (options_.from_buffers) {
    if (frame.scene) casters.assign(frame.scene->instance_bounds().begin(), frame.scene->instance_bounds().end());
    if (!frame.draw_bounds.empty()) casters.push_back(frame.draw_bounds);
    options.casters = casters;
  }
  Box scene = frame.draw_bounds;
  if (frame.scene) scene.extend(frame.scene->bounds());
  views_.clear();
  double drawn = 0, fallback = 0;
  std::vector<double> shifts, gains;
  const std::vector<LightFrame> lights = light_frames(frame.light);
  for (uint32_t layer = 0; layer < lights.size(); ++layer) {
    const MapView& plain = plain_.views()[layer];
    options.plain = plain.drawn ? &plain.light_from_world : nullptr;
    const Warp warp = choose_warp(frame.light, lights[layer], CameraMap(frame.camera), receivers, scene, options);
    MapView view;
    view.layer = layer;
    view.viewport = vk::Rect2D({0, 0}, {resolution_, resolution_});
    view.drawn = warp.drawn;
    view.light_from_world = warp.light_from_world;
    if (view.drawn) {
      view.casters = caster_planes(view, frame.camera, frame.light, true, warp.reach);
      drawn += 1;
      fallback += warp.fallback;
      shifts.push_back(warp.shift);
      gains.push_back(warp.gain);
    }
    views_.push_back(std::move(view));
  }
  const auto resolution = static_cast<double>(resolution_);
  counters_ = {{"effective_resolution", {resolution, resolution}},
               {"views", {drawn}},
               {"fallback", {fallback}},
               {"near", {receivers.nearest}},
               {"far", {receivers.farthest}},
               {"shift", std::move(shifts)},
               {"gain", std::move(gains)}};
}

std::vector<Allocation> Perspective::allocations() const {
  if (!options_.from_buffers) return {};
  return {camera_.allocation(), tiles_.allocation()};
}

Picture Perspective::debug_picture(std::string_view, const ReceiverLookup& lookup) {
  Picture picture{lookup.width, lookup.height, {}};
  for (const uint32_t word : receiver_words(device_, shaders::show_aliasing_comp, lookup))
    picture.pixels.push_back(aliasing_color(std::bit_cast<float>(word)));
  return picture;
}

}  // namespace shadewright::shadow
