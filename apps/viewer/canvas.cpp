#include "canvas.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <new>
#include <numeric>

#include "compare/difference.h"
#include "render/shared.h"
#include "shaders/compose_frag.h"
#include "shaders/whole_image_vert.h"
#include "shadewright/compare/metrics.h"
#include "shadewright/error.h"
#include "shadewright/render/image.h"
#include "shadow/lookup_data.h"

namespace shadewright::viewer {

namespace {

constexpr vk::Format picture_format = vk::Format::eR8G8B8A8Unorm;

glm::vec3 color(const glm::u8vec4& c) {
  return glm::vec3(c) / 255.0f;
}

bool same_view(const Moment& a, const Moment& b) {
  const Camera &c = a.camera, &d = b.camera;
  return a.time == b.time && c.eye == d.eye && c.target == d.target && c.up == d.up && c.fov_y == d.fov_y &&
         c.near == d.near;
}

/// What `work` could not do, one sentence; empty if it could. The other side goes on.
std::string problem_of(const std::function<void()>& work) {
  try {
    work();
    return "";
  } catch (const vk::DeviceLostError&) {
    throw;
  } catch (const vk::SystemError& error) {
    return std::string("the device can't do this: ") + error.what();
  } catch (const Error& error) {
    return error.what();
  } catch (const std::bad_alloc&) {
    return "out of memory; use a lower resolution";
  }
}

double total(std::span<const gpu::StageTime> stages) {
  return std::accumulate(stages.begin(), stages.end(), 0.0,
                         [](double sum, const gpu::StageTime& stage) { return sum + stage.milliseconds; });
}

}  // namespace

Canvas::Canvas(const gpu::Device& device, const Scene& scene, shadow::BakeShadow bake)
    : device_(device),
      scene_(scene),
      bake_(std::move(bake)),
      scene_gpu_(device, scene, 0, 1),
      sampler_(gpu::make_sampler(device, vk::Filter::eNearest)),
      camera_(device, "viewer camera", sizeof(shadewright::shared::CameraData), gpu::HostAccess::write) {
  using enum gpu::BindingKind;
  gpu::GraphicsDesc desc;
  desc.vertex = shaders::whole_image_vert;
  desc.fragment = shaders::compose_frag;
  desc.kinds = {sampled_image, sampled_image, sampled_image, sampled_image,
                sampled_image, sampled_image, uniform_buffer};
  desc.push_bytes = sizeof(shared::ComposeConstants);
  desc.colors = {picture_format};
  desc.depth = vk::Format::eUndefined;
  compose_ = gpu::GraphicsPass(device, desc);
}

void Canvas::resize(uint32_t width, uint32_t height) {
  using Usage = vk::ImageUsageFlagBits;
  drawn_.reset();
  truth_.reset();
  image_ = gpu::Image(device_, {"picture", picture_format, width, height, 1,
                                Usage::eColorAttachment | Usage::eTransferSrc | Usage::eTransferDst});
  gpu::submit_and_wait(device_, [&](const vk::raii::CommandBuffer& commands) {
    image_.transition(commands, vk::ImageLayout::eTransferDstOptimal, true);
    commands.clearColorImage(image_.handle(), vk::ImageLayout::eTransferDstOptimal, vk::ClearColorValue(),
                             vk::ImageSubresourceRange(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1));
    image_.transition(commands, vk::ImageLayout::eTransferSrcOptimal);
  });
  camera_pass_ = std::make_unique<render::CameraPass>(scene_gpu_, width, height, true);
  for (Side& side : sides_) make_technique(side);
}

void Canvas::set_technique(size_t side, const std::optional<shadow::Spec>& spec) {
  sides_[side].spec = spec;
  make_technique(sides_[side]);
}

void Canvas::make_technique(Side& side) {
  composed_.reset();
  side.technique.reset();
  side.checked.reset();
  side.answered = false;
  side.frames = 0;
  side.figures = {};
  if (!side.spec || side.is_truth() || !image_) return;
  const vk::Extent2D size = image_.extent();
  side.figures.problem = problem_of([&] {
    side.technique =
        shadow::make_technique(device_, *side.spec, {size.width, size.height, 1, true, &scene_, no_progress, bake_});
  });
}

bool Canvas::draw(const Moment& moment, const Look& look) {
  const bool moves = !drawn_ || !same_view(*drawn_, moment);
  const bool new_light = !drawn_ || !shadow::same_light(drawn_->light, moment.light);
  if (new_light) lamp_distance_ = render::lamp_distance(moment.light, moment.camera);
  if (moves || new_light) {
    traced_ = false;
    composed_.reset();
    for (Side& side : sides_) side.answered = false;
  }
  if (composed_ == look) return false;
  if (moves) draw_camera(moment);
  drawn_ = moment;
  if (look.show == Show::wrong || sides_[left].is_truth() || sides_[right].is_truth()) trace();
  for (Side& side : sides_) {
    if (!side.answered) answer(side);
    if (look.show == Show::wrong) measure(side);
  }
  compose(look);
  composed_ = look;
  return true;
}

bool Canvas::has_cold_figures() const {
  return std::ranges::any_of(sides_, [](const Side& side) { return side.frames == 1; });
}

void Canvas::forget_cold_figures() {
  for (Side& side : sides_) {
    if (side.frames != 1) continue;
    side.answered = false;
    composed_.reset();
  }
}

void Canvas::draw_camera(const Moment& moment) {
  const auto [width, height] = image_.extent();
  view_ = render::make_view(moment.camera, near_distance(scene_, moment.camera), width, height);
  gpu::Recorder mover(device_);
  scene_gpu_.update(scene_, moment.time, 0, mover);
  mover.finish();
  gpu::Recorder recorder(device_);
  camera_pass_->record(recorder, view_);
  camera_milliseconds_ = total(recorder.finish());
  camera_.mapped<shadewright::shared::CameraData>()[0] = render::camera_data(view_);
}

void Canvas::trace() {
  if (traced_) return;
  const auto [width, height] = image_.extent();
  if (!truth_) truth_ = std::make_unique<Truth>(device_, scene_, width, height);
  truth_->trace(*drawn_, *camera_pass_, view_);
  traced_ = true;
}

void Canvas::answer(Side& side) {
  side.answered = true;
  side.figures.error.reset();
  if (side.is_truth()) {
    side.figures.stages = {{"shadow rays", truth_->milliseconds()}};
    side.figures.milliseconds = truth_->milliseconds();
    return;
  }
  const bool checked = side.checked && shadow::same_light(*side.checked, drawn_->light);
  if (!side.technique || (checked && !side.figures.problem.empty())) return;
  side.checked = drawn_->light;
  shadow::Frame frame;
  frame.scene = &scene_gpu_;
  frame.camera = view_;
  frame.depth = camera_pass_->depth().view();
  frame.normal = camera_pass_->normal().view();
  frame.light = drawn_->light;
  SideFigures figures;
  figures.problem = problem_of([&] {
    if (!checked) shadow::check(*side.spec, scene_, drawn_->light);
    gpu::Recorder recorder(device_);
    side.technique->prepare(frame, recorder);
    side.technique->record(frame, recorder);
    figures.stages = recorder.finish();
    figures.milliseconds = total(figures.stages);
    ++side.frames;
    for (const Allocation& allocation : side.technique->allocations()) figures.bytes += allocation.bytes;
  });
  side.figures = figures;
}

void Canvas::measure(Side& side) {
  if (!side.has_answer() || side.is_truth() || side.figures.error) return;
  gpu::Image& answer = side.technique->visibility();
  side.figures.error = truth_->error(gpu::read_back(device_, answer, 1));
  gpu::submit_and_wait(device_, [&](const vk::raii::CommandBuffer& commands) {
    answer.transition(commands, vk::ImageLayout::eShaderReadOnlyOptimal);
  });
}

gpu::Image& Canvas::visibility(const Side& side) {
  if (side.is_truth()) return truth_->visibility();
  // Whatever is bound is not looked at where there is no answer.
  return side.has_answer() ? side.technique->visibility() : camera_pass_->depth();
}

void Canvas::compose(const Look& look) {
  const Light& light = drawn_->light;
  const bool sun = light.kind == LightKind::directional;
  shared::ComposeConstants constants;
  constants.light = sun ? glm::vec4(-glm::vec3(light.direction), 0.0f) : glm::vec4(glm::vec3(light.position), 1.0f);
  constants.lamp_distance = static_cast<float>(lamp_distance_);
  constants.divider = static_cast<float>(look.divider * image_.desc().width);
  constants.show = static_cast<uint32_t>(look.show);
  constants.answered = 0;
  for (const size_t side : {left, right})
    if (sides_[side].has_answer()) constants.answered |= 1u << side;
  constants.least_cosine = static_cast<float>(compare::edge_on_cosine);
  constants.false_shadow = color(compare::false_shadow_color);
  constants.false_lit = color(compare::false_lit_color);

  gpu::submit_and_wait(device_, [&](const vk::raii::CommandBuffer& commands) {
    using Layout = vk::ImageLayout;
    image_.transition(commands, Layout::eColorAttachmentOptimal, true);
    camera_pass_->albedo().transition(commands, Layout::eShaderReadOnlyOptimal);
    const vk::RenderingAttachmentInfo target(image_.view(), Layout::eColorAttachmentOptimal, {}, {}, {},
                                             vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eStore);
    const vk::Rect2D area({0, 0}, image_.extent());
    commands.beginRendering({{}, area, 1, 0, target});
    commands.setViewport(
        0, vk::Viewport(0, 0, static_cast<float>(area.extent.width), static_cast<float>(area.extent.height), 0, 1));
    commands.setScissor(0, area);
    const auto sampled = [&](gpu::Image& image) { return gpu::Binding::sampled(image.view(), *sampler_); };
    gpu::Image& truth = traced_ ? truth_->visibility() : camera_pass_->depth();
    const gpu::Binding bindings[] = {sampled(camera_pass_->depth()),     sampled(camera_pass_->normal()),
                                     sampled(camera_pass_->albedo()),    sampled(visibility(sides_[left])),
                                     sampled(visibility(sides_[right])), sampled(truth),
                                     gpu::Binding::uniform(camera_)};
    compose_.bind(commands, bindings, gpu::bytes_of(constants));
    commands.draw(3, 1, 0, 0);
    commands.endRendering();
    image_.transition(commands, Layout::eTransferSrcOptimal);
  });
}

Picture Canvas::picture() {
  const auto bytes = gpu::read_back(device_, image_, 4);
  Picture picture{image_.desc().width, image_.desc().height, std::vector<glm::u8vec4>(bytes.size() / 4)};
  std::memcpy(picture.pixels.data(), bytes.data(), bytes.size());
  return picture;
}

std::vector<std::string> Canvas::debug_names(size_t side) const {
  return sides_[side].technique ? sides_[side].technique->debug_names() : std::vector<std::string>{};
}

Picture Canvas::debug_picture(size_t side, const std::string& name) {
  return sides_[side].technique->debug_picture(name);
}

}  // namespace shadewright::viewer
