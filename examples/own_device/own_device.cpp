// Shadows in an engine that has a Vulkan device, command buffers and casters of its own. From top to bottom: the
// engine's device, the library on it, the engine's caster, a frame, and the proof: the mask against ray tracing.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "shadewright/error.h"
#include "shadewright/raytrace/tracer.h"
#include "shadewright/render/camera_pass.h"
#include "shadewright/scene/load.h"
#include "shadewright/shadow/technique.h"

namespace {

using namespace shadewright;
using glm::vec3;
using glm::vec4;
using std::cos, std::sin;
#include "ring.h"

constexpr uint32_t caster_spirv[] = {
#include "caster.vert.inc"
};

constexpr uint32_t width = 640, height = 480;

// ---------------------------------------------------------------------------------------------------- 1. the engine's
// device

/// What an engine has anyway. Vulkan-Hpp here for shortness: the library takes plain C handles.
struct Engine {
  vk::raii::Context context;
  vk::raii::Instance instance{nullptr};
  vk::raii::PhysicalDevice physical{nullptr};
  vk::raii::Device device{nullptr};
  vk::raii::Queue queue{nullptr};
  vk::raii::CommandPool pool{nullptr};
  uint32_t queue_family = 0;

  Engine() {
    const vk::ApplicationInfo application("own_device", 1, nullptr, 0, VK_API_VERSION_1_3);
    instance = vk::raii::Instance(context, {{}, &application});
    choose_device();

    // The library says which extensions and features it needs; an engine adds its own to them.
    const std::vector<const char*> extensions = gpu::Device::required_extensions();
    gpu::DeviceFeatures features;
    gpu::Device::required_features(features);
    features.core.features.samplerAnisotropy = physical.getFeatures().samplerAnisotropy;
    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue_info({}, queue_family, 1, &priority);
    vk::DeviceCreateInfo info({}, queue_info, {}, extensions);
    info.pNext = &features.core;
    device = vk::raii::Device(physical, info);
    queue = vk::raii::Queue(device, queue_family, 0);
    pool = vk::raii::CommandPool(device, {{}, queue_family});
  }

  /// The first device that the library can use, with a queue for graphics and compute.
  void choose_device() {
    const auto wanted = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
    for (const auto& candidate : instance.enumeratePhysicalDevices()) {
      if (!gpu::Device::why_unusable(candidate).empty()) continue;
      const auto families = candidate.getQueueFamilyProperties();
      for (queue_family = 0; queue_family < families.size(); ++queue_family) {
        if ((families[queue_family].queueFlags & wanted) != wanted) continue;
        physical = candidate;
        return;
      }
    }
    throw FailureError("own_device", "no Vulkan device here will do", "install mesa-vulkan-drivers");
  }

  gpu::AdoptedDevice handles() const { return {*instance, *physical, *device, *queue, queue_family}; }
};

// ---------------------------------------------------------------------------------------------------- 2. the engine's
// caster

/// Draws the ring into whatever shadow map a technique asks for.
class RingCaster {
 public:
  RingCaster(const Engine& engine, const shadow::Technique& technique, const vec4& place) : place_(place) {
    // The technique's set holds its matrices. The vertex shader has it as set 0.
    const vk::DescriptorSetLayout set_layout = technique.lookup_layout();
    const vk::PushConstantRange push(vk::ShaderStageFlagBits::eVertex, 0, sizeof(Push));
    layout_ = vk::raii::PipelineLayout(engine.device, {{}, set_layout, push});

    // Depth only. Clamped, so that a caster between the light and the map's nearest depth still counts.
    const vk::raii::ShaderModule vertex(engine.device, {{}, sizeof(caster_spirv), caster_spirv});
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eVertex, *vertex, "main");
    const vk::PipelineVertexInputStateCreateInfo no_vertex_buffers;
    const vk::PipelineInputAssemblyStateCreateInfo triangles({}, vk::PrimitiveTopology::eTriangleList);
    const vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
    vk::PipelineRasterizationStateCreateInfo raster;
    raster.depthClampEnable = VK_TRUE;
    raster.lineWidth = 1.0f;
    const vk::PipelineMultisampleStateCreateInfo one_sample;
    const vk::PipelineDepthStencilStateCreateInfo depth({}, VK_TRUE, VK_TRUE, vk::CompareOp::eLess);
    const vk::DynamicState dynamic_states[] = {vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamic({}, dynamic_states);
    const vk::PipelineRenderingCreateInfo attachments(0, {}, vk::Format::eD32Sfloat);
    vk::GraphicsPipelineCreateInfo info({}, stage, &no_vertex_buffers, &triangles, nullptr, &viewport, &raster,
                                        &one_sample, &depth, nullptr, &dynamic, *layout_);
    info.pNext = &attachments;
    pipeline_ = vk::raii::Pipeline(engine.device, nullptr, info);
  }

  /// Called once for each view of the map, inside its rendering.
  void draw(const shadow::CasterDraw& target) const {
    const Push push{place_, target.view};
    target.commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
    target.commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, target.set, {});
    target.commands.pushConstants<Push>(*layout_, vk::ShaderStageFlagBits::eVertex, 0, push);
    target.commands.draw(static_cast<uint32_t>(ring_vertices), 1, 0, 0);
  }

  /// World bounds: the shadow map must know where its casters may be.
  Box bounds() const {
    const glm::dvec3 center(place_), reach(1.25 * place_.w, 0.25 * place_.w, 1.25 * place_.w);
    return {center - reach, center + reach};
  }

  /// The same triangles for the ray tracer.
  Mesh mesh() const {
    Mesh mesh;
    for (int vertex = 0; vertex < ring_vertices; ++vertex) mesh.positions.push_back(ring_position(vertex, place_));
    for (uint32_t i = 0; i < mesh.positions.size(); i += 3) mesh.triangles.emplace_back(i, i + 1, i + 2);
    return mesh;
  }

 private:
  struct Push {
    vec4 place;
    uint32_t view;
  };

  vec4 place_;
  vk::raii::PipelineLayout layout_{nullptr};
  vk::raii::Pipeline pipeline_{nullptr};
};

// ---------------------------------------------------------------------------------------------------- 3. a frame

/// Records camera pass, shadow map and look-up into a command buffer of the engine's, submits it, and returns the mask.
std::vector<uint8_t> draw_frame(const Engine& engine, const gpu::Device& device, render::CameraPass& camera_pass,
                                shadow::Technique& technique, const shadow::Frame& frame) {
  const vk::raii::CommandBuffers buffers(engine.device, {*engine.pool, vk::CommandBufferLevel::ePrimary, 1});
  const vk::raii::CommandBuffer& commands = buffers.front();
  commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});

  // An engine draws depth and normals itself; here the library's own pass does. Passes and techniques record through a
  // Recorder, which for a caller's command buffer neither submits nor waits.
  gpu::Recorder recorder(device, *commands);
  camera_pass.record(recorder, frame.camera);

  technique.prepare(frame, recorder);  // matrices, on the CPU
  technique.record(frame, *commands);  // shadow map, look-up

  // The mask is an image to sample in the lighting pass. To look at it here, copy it to memory that the host reads.
  gpu::Image& mask = technique.visibility();
  const gpu::Buffer pixels(device, "mask pixels", width * height, gpu::HostAccess::read);
  mask.transition(commands, vk::ImageLayout::eTransferSrcOptimal);
  const vk::BufferImageCopy region(0, 0, 0, {mask.aspect(), 0, 0, 1}, {}, {width, height, 1});
  commands.copyImageToBuffer(mask.handle(), vk::ImageLayout::eTransferSrcOptimal, pixels.handle(), region);
  const vk::MemoryBarrier2 to_host(vk::PipelineStageFlagBits2::eCopy, vk::AccessFlagBits2::eTransferWrite,
                                   vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
  commands.pipelineBarrier2({{}, to_host});
  commands.end();

  const vk::raii::Fence fence(engine.device, vk::FenceCreateInfo{});
  engine.queue.submit(vk::SubmitInfo({}, {}, *commands), *fence);
  if (engine.device.waitForFences(*fence, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess)
    throw FailureError("own_device", "the frame did not finish");
  const auto bytes = pixels.mapped<uint8_t>().first(width * height);
  return {bytes.begin(), bytes.end()};
}

int run() {
  const Engine engine;
  const gpu::Device device(engine.handles());
  std::printf("on %s\n", device.info().name.c_str());

  Scene scene = load_scene("builtin:spheres").scene;
  const Camera& camera = scene.cameras.front();
  const Light& light = scene.lights.front();
  const render::SceneGpu scene_gpu(device, scene);
  render::CameraPass camera_pass(scene_gpu, width, height, false);
  const render::CameraView view = render::make_view(camera, near_distance(scene, camera), width, height);

  const auto technique = shadow::make_technique(device, shadow::parse_spec("sm@1024"),
                                                {.width = width, .height = height, .allow_readback = false});
  const vec4 place(camera.target + glm::dvec3(0, 2, 0), 2.0);
  const RingCaster ring(engine, *technique, place);

  shadow::Frame frame;
  frame.scene = &scene_gpu;
  frame.draw_casters = [&](const shadow::CasterDraw& target) { ring.draw(target); };
  frame.draw_bounds = ring.bounds();
  frame.camera = view;
  frame.depth = camera_pass.depth().view();
  frame.normal = camera_pass.normal().view();
  frame.light = light;
  const std::vector<uint8_t> mask = draw_frame(engine, device, camera_pass, *technique, frame);

  // ---------------------------------------------------------------------------------------------------- 4. the proof

  // Rays from the very surface points that the camera pass drew, once without the ring and once with it.
  const std::vector<SurfacePoint> points = camera_pass.surface_points(view);
  const vec3 eye(view.eye());
  const std::vector<uint8_t> without_ring = Tracer(scene).visible(points, eye, light, width);
  Instance instance;
  instance.mesh = static_cast<uint32_t>(scene.meshes.size());
  scene.meshes.push_back(ring.mesh());
  scene.instances.push_back(instance);
  const std::vector<uint8_t> truth = Tracer(scene).visible(points, eye, light, width);

  size_t seen = 0, wrong = 0, ring_shadow = 0, ring_shadow_found = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    if (!points[i].valid()) continue;
    const bool lit = mask[i] >= 128;
    ++seen;
    wrong += lit != (truth[i] != 0);
    if (without_ring[i] != 0 && truth[i] == 0) {
      ++ring_shadow;
      ring_shadow_found += !lit;
    }
  }
  const double mismatch = static_cast<double>(wrong) / static_cast<double>(seen);
  std::printf("mask against ray tracing: %zu of %zu pixels differ (%.3f %%)\n", wrong, seen, 100 * mismatch);
  std::printf("the ring's own shadow: %zu of its %zu pixels are dark\n", ring_shadow_found, ring_shadow);

  // The ring's shadow is many times the pixels that may differ: without it, or with it elsewhere, the example fails.
  return mismatch <= 0.005 && ring_shadow > seen / 50 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main() {
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "own_device: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
