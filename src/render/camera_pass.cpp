#include "shadewright/render/camera_pass.h"

#include <array>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/packing.hpp>

#include "render/octahedral.h"
#include "render/shared.h"
#include "shaders/camera_albedo_frag.h"
#include "shaders/camera_albedo_vert.h"
#include "shaders/camera_frag.h"
#include "shaders/camera_vert.h"
#include "shadewright/error.h"
#include "shadewright/geometry/projection.h"

namespace shadewright::render {

namespace {

/// Rows 0, 1 and 3 of clip_from_world, which tell where a point is on the screen: (ndc.x * w, ndc.y * w, w) = m * p +
/// t.
struct ScreenMap {
  glm::dmat3 m;
  glm::dvec3 t;

  explicit ScreenMap(const glm::dmat4& clip_from_world) {
    const glm::dvec4 x = glm::row(clip_from_world, 0), y = glm::row(clip_from_world, 1),
                     w = glm::row(clip_from_world, 3);
    m = glm::transpose(glm::dmat3(glm::dvec3(x), glm::dvec3(y), glm::dvec3(w)));
    t = {x.w, y.w, w.w};
  }
};

}  // namespace

glm::dvec3 CameraView::eye() const {
  const ScreenMap screen(clip_from_world);
  return -(glm::inverse(screen.m) * screen.t);
}

glm::dvec3 CameraView::ray(const glm::dvec2& pixel) const {
  const glm::dvec2 ndc = 2.0 * pixel / glm::dvec2(width, height) - 1.0;
  return glm::inverse(ScreenMap(clip_from_world).m) * glm::dvec3(ndc, 1.0);
}

CameraView make_view(const Camera& camera, double near, uint32_t width, uint32_t height) {
  const glm::dmat4 view = look_along(camera.eye, camera.target - camera.eye, camera.up);
  const double aspect = static_cast<double>(width) / height;
  return {perspective_reversed_infinite(camera.fov_y, aspect, near) * view, width, height, 0.0f};
}

shared::CameraData camera_data(const CameraView& view) {
  const glm::dvec4 z = glm::row(view.clip_from_world, 2), w = glm::row(view.clip_from_world, 3);
  const glm::dvec3 axis(w);
  if (glm::dot(axis, axis) == 0)
    throw InputError("camera", "an orthographic camera has no view depth to read shadows with",
                     "give a perspective one");
  // The depth row is a combination of the w row and a constant: z = scale * w + offset, hence depth = scale + offset /
  // w.
  const double scale = glm::dot(glm::dvec3(z), axis) / glm::dot(axis, axis);
  shared::CameraData data;
  const glm::dvec3 eye = view.eye();
  data.eye = glm::vec3(eye);
  // Relative to the eye as the shader knows it, in float.
  glm::dmat4 from_relative = view.clip_from_world;
  from_relative[3] = view.clip_from_world * glm::dvec4(glm::dvec3(data.eye), 1.0);
  data.clip_from_relative = glm::mat4(from_relative);
  data.ray_from_ndc = glm::mat3(glm::inverse(ScreenMap(view.clip_from_world).m));
  data.depth_scale = static_cast<float>(scale);
  data.depth_offset = static_cast<float>(z.w - scale * w.w);
  data.background_depth = view.background_depth;
  data.size = {view.width, view.height};
  return data;
}

CameraPass::CameraPass(const SceneGpu& scene, uint32_t width, uint32_t height, bool with_albedo)
    : scene_(scene), draws_(scene, 1, 1, "camera") {
  using Usage = vk::ImageUsageFlagBits;
  const gpu::Device& device = scene.device();
  const auto read = Usage::eSampled | Usage::eTransferSrc;
  depth_ = gpu::Image(
      device, {"camera depth", vk::Format::eD32Sfloat, width, height, 1, Usage::eDepthStencilAttachment | read});
  normal_ =
      gpu::Image(device, {"camera normal", vk::Format::eR16G16Snorm, width, height, 1, Usage::eColorAttachment | read});
  if (with_albedo)
    albedo_ = gpu::Image(
        device, {"camera albedo", vk::Format::eR8G8B8A8Unorm, width, height, 1, Usage::eColorAttachment | read});
  camera_ = gpu::Buffer(device, "camera", sizeof(shared::CameraData), gpu::HostAccess::write);

  using enum gpu::BindingKind;
  gpu::GraphicsDesc desc;
  desc.vertex = with_albedo ? std::span<const uint32_t>(shaders::camera_albedo_vert) : shaders::camera_vert;
  desc.fragment = with_albedo ? std::span<const uint32_t>(shaders::camera_albedo_frag) : shaders::camera_frag;
  desc.kinds = {storage_buffer, uniform_buffer};
  CulledDraws::set_vertex_input(desc, with_albedo ? SceneInputs::colored_surface : SceneInputs::surface);
  desc.colors = {vk::Format::eR16G16Snorm};
  if (with_albedo) desc.colors.push_back(vk::Format::eR8G8B8A8Unorm);
  desc.depth_compare = vk::CompareOp::eGreater;
  pass_ = gpu::GraphicsPass(device, desc);
}

void CameraPass::record(gpu::Recorder& recorder, const CameraView& view) {
  camera_.mapped<shared::CameraData>()[0] = camera_data(view);
  recorder.cpu_stage("camera order", [&] {
    const std::array planes{view.planes()};
    draws_.set_views(0, planes, scene_.front_to_back(view.eye()));
  });
  recorder.stage("camera cull", [&](const vk::raii::CommandBuffer& commands) { draws_.cull(commands, 0); });
  recorder.stage("camera", [&](const vk::raii::CommandBuffer& commands) {
    using Layout = vk::ImageLayout;
    std::vector<vk::RenderingAttachmentInfo> colors;
    for (gpu::Image* image : {&normal_, &albedo_}) {
      if (!*image) continue;
      image->transition(commands, Layout::eColorAttachmentOptimal, true);
      colors.push_back({image->view(),
                        Layout::eColorAttachmentOptimal,
                        {},
                        {},
                        {},
                        vk::AttachmentLoadOp::eClear,
                        vk::AttachmentStoreOp::eStore,
                        vk::ClearValue{}});
    }
    depth_.transition(commands, Layout::eDepthAttachmentOptimal, true);
    const vk::RenderingAttachmentInfo depth(depth_.view(), Layout::eDepthAttachmentOptimal, {}, {}, {},
                                            vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
                                            vk::ClearDepthStencilValue(view.background_depth, 0));
    const vk::Rect2D area({0, 0}, depth_.extent());
    commands.beginRendering({{}, area, 1, 0, colors, &depth});
    commands.setViewport(
        0, vk::Viewport(0, 0, static_cast<float>(area.extent.width), static_cast<float>(area.extent.height), 0, 1));
    commands.setScissor(0, area);
    using gpu::Binding;
    const Binding bindings[] = {Binding::storage(scene_.triangle_normals()), Binding::uniform(camera_)};
    pass_.bind(commands, bindings, {});
    draws_.draw(commands, 0);
    commands.endRendering();
    depth_.transition(commands, Layout::eShaderReadOnlyOptimal);
    normal_.transition(commands, Layout::eShaderReadOnlyOptimal);
  });
}

std::vector<Allocation> CameraPass::allocations() const {
  std::vector<Allocation> result{depth_.allocation(), normal_.allocation(), camera_.allocation()};
  if (albedo_) result.push_back(albedo_.allocation());
  for (auto& allocation : draws_.allocations()) result.push_back(std::move(allocation));
  return result;
}

std::vector<SurfacePoint> CameraPass::surface_points(const CameraView& view) {
  const gpu::Device& device = scene_.device();
  const auto depths = gpu::read_back(device, depth_, sizeof(float));
  const auto normals = gpu::read_back(device, normal_, sizeof(uint32_t));
  gpu::submit_and_wait(device, [&](const auto& commands) {
    depth_.transition(commands, vk::ImageLayout::eShaderReadOnlyOptimal);
    normal_.transition(commands, vk::ImageLayout::eShaderReadOnlyOptimal);
  });
  const shared::CameraData data = camera_data(view);
  const glm::dvec3 origin = view.ray({0.5, 0.5}), dx = view.ray({1.5, 0.5}) - origin,
                   dy = view.ray({0.5, 1.5}) - origin;
  std::vector<SurfacePoint> points(size_t{view.width} * view.height);
  for (uint32_t y = 0; y < view.height; ++y)
    for (uint32_t x = 0; x < view.width; ++x) {
      const size_t i = size_t{y} * view.width + x;
      float depth;
      std::memcpy(&depth, depths.data() + i * sizeof(float), sizeof(float));
      if (depth == view.background_depth) continue;
      uint32_t normal;
      std::memcpy(&normal, normals.data() + i * sizeof(uint32_t), sizeof(uint32_t));
      const double view_depth = data.depth_offset / (static_cast<double>(depth) - data.depth_scale);
      const glm::dvec3 ray = origin + static_cast<double>(x) * dx + static_cast<double>(y) * dy;
      points[i] = {glm::vec3(glm::dvec3(data.eye) + ray * view_depth),
                   glm::normalize(octahedral_direction(glm::unpackSnorm2x16(normal)))};
    }
  return points;
}

}  // namespace shadewright::render
