// sm@2048 at 1080p against the least that a shadow map can cost on the same device: one draw of all triangles in world
// space and a one-tap look-up. Usage: sm_against_bare [SCENE] [REPEATS]. Both take turns, so that a busy machine slows
// them alike.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "render/shared.h"
#include "shaders/bare_depth_vert.h"
#include "shaders/bare_lookup_comp.h"
#include "shadewright/gpu/pass.h"
#include "shadewright/render/camera_pass.h"
#include "shadewright/scene/load.h"
#include "shadewright/shadow/technique.h"

using namespace shadewright;

namespace {

constexpr uint32_t width = 1920, height = 1080, resolution = 2048;

/// Every triangle of every instance, in world space.
struct FlatScene {
  std::vector<glm::vec3> positions;
  std::vector<uint32_t> indices;

  explicit FlatScene(const Scene& scene) {
    for (const Instance& instance : scene.instances) {
      const Mesh& mesh = scene.meshes[instance.mesh];
      const auto base = static_cast<uint32_t>(positions.size());
      const glm::dmat4 world_from_mesh = transform_at(scene, instance, 0);
      for (const glm::vec3& p : mesh.positions)
        positions.emplace_back(world_from_mesh * glm::dvec4(glm::dvec3(p), 1.0));
      for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) indices.push_back(base + t[k]);
    }
  }
};

class BareShadowMap {
 public:
  BareShadowMap(const gpu::Device& device, const FlatScene& scene)
      : positions_(gpu::make_buffer<glm::vec3>(device, "positions", scene.positions)),
        indices_(gpu::make_buffer<uint32_t>(device, "indices", scene.indices)),
        index_count_(static_cast<uint32_t>(scene.indices.size())),
        camera_(device, "camera", sizeof(shared::CameraData), gpu::HostAccess::write),
        map_(device, {"map", vk::Format::eD32Sfloat, resolution, resolution, 1,
                      vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled}),
        visibility_(device, {"visibility", vk::Format::eR8Unorm, width, height, 1, vk::ImageUsageFlagBits::eStorage}),
        sampler_(gpu::make_sampler(device, vk::Filter::eNearest)) {
    gpu::GraphicsDesc desc;
    desc.vertex = shaders::bare_depth_vert;
    desc.push_bytes = sizeof(glm::mat4);
    desc.vertex_bindings = {{0, sizeof(glm::vec3), vk::VertexInputRate::eVertex}};
    desc.vertex_attributes = {{0, 0, vk::Format::eR32G32B32Sfloat, 0}};
    draw_ = gpu::GraphicsPass(device, desc);
    using enum gpu::BindingKind;
    lookup_ = gpu::ComputePass(device, shaders::bare_lookup_comp,
                               {uniform_buffer, sampled_image, sampled_image, storage_image}, sizeof(glm::mat4));
  }

  void record(gpu::Recorder& recorder, const render::CameraView& view, vk::ImageView camera_depth,
              const glm::mat4& clip_from_world) {
    camera_.mapped<shared::CameraData>()[0] = render::camera_data(view);
    recorder.stage("bare map", [&](const vk::raii::CommandBuffer& commands) {
      map_.transition(commands, vk::ImageLayout::eDepthAttachmentOptimal, true);
      const vk::RenderingAttachmentInfo depth(map_.view(), vk::ImageLayout::eDepthAttachmentOptimal, {}, {}, {},
                                              vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
                                              vk::ClearDepthStencilValue(1.0f, 0));
      vk::RenderingInfo rendering({}, {{0, 0}, map_.extent()}, 1);
      rendering.pDepthAttachment = &depth;
      commands.beginRendering(rendering);
      commands.setViewport(0, vk::Viewport(0, 0, resolution, resolution, 0, 1));
      commands.setScissor(0, vk::Rect2D({0, 0}, map_.extent()));
      draw_.bind(commands, {}, gpu::bytes_of(clip_from_world));
      commands.bindVertexBuffers(0, positions_.handle(), vk::DeviceSize{0});
      commands.bindIndexBuffer(indices_.handle(), 0, vk::IndexType::eUint32);
      commands.drawIndexed(index_count_, 1, 0, 0, 0);
      commands.endRendering();
      map_.transition(commands, vk::ImageLayout::eShaderReadOnlyOptimal);
    });
    recorder.stage("bare look-up", [&](const vk::raii::CommandBuffer& commands) {
      using gpu::Binding;
      visibility_.transition(commands, vk::ImageLayout::eGeneral, true);
      const Binding bindings[] = {Binding::uniform(camera_), Binding::sampled(camera_depth, *sampler_),
                                  Binding::sampled(map_.view(), *sampler_), Binding::storage(visibility_.view())};
      lookup_.dispatch(commands, bindings, gpu::bytes_of(clip_from_world), {width / 8, height / 8, 1});
    });
  }

 private:
  gpu::Buffer positions_, indices_;
  uint32_t index_count_;
  gpu::Buffer camera_;
  gpu::Image map_, visibility_;
  vk::raii::Sampler sampler_;
  gpu::GraphicsPass draw_;
  gpu::ComputePass lookup_;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  const Scene scene = load_scene(argc > 1 ? argv[1] : "builtin:city?triangles=500000").scene;
  const int repeats = argc > 2 ? std::stoi(argv[2]) : 15;
  const Camera camera = scene.cameras.empty() ? default_camera(scene) : scene.cameras.front();
  const Light light = scene.lights.empty() ? sun(35, 45) : scene.lights.front();
  const gpu::Device device;
  const render::SceneGpu scene_gpu(device, scene);
  render::CameraPass camera_pass(scene_gpu, width, height, false);
  const render::CameraView view = render::make_view(camera, near_distance(scene, camera), width, height);
  BareShadowMap bare(device, FlatScene(scene));
  const auto sm = shadow::make_technique(device, shadow::parse_spec("sm@2048"), {width, height, 1, true});

  shadow::Frame frame;
  frame.scene = &scene_gpu;
  frame.camera = view;
  frame.light = light;
  std::map<std::string, std::vector<double>> stages;
  std::vector<double> ours, theirs, cameras;
  for (int i = 0; i <= repeats; ++i) {
    const auto total = [&](gpu::Recorder& recorder) {
      double sum = 0;
      for (const gpu::StageTime& stage : recorder.finish()) {
        sum += stage.milliseconds;
        if (i > 0) stages[stage.name].push_back(stage.milliseconds);
      }
      return sum;
    };
    gpu::Recorder for_camera(device), for_sm(device), for_bare(device);
    camera_pass.record(for_camera, view);
    const double camera_ms = total(for_camera);
    frame.depth = camera_pass.depth().view();
    frame.normal = camera_pass.normal().view();
    sm->prepare(frame, for_sm);
    sm->record(frame, for_sm);
    const double sm_ms = total(for_sm);
    bare.record(for_bare, view, frame.depth, glm::mat4(sm->views()[0].light_from_world));
    const double bare_ms = total(for_bare);
    if (i == 0) continue;  // the first frame compiles shaders
    cameras.push_back(camera_ms);
    ours.push_back(sm_ms);
    theirs.push_back(bare_ms);
  }
  for (const auto& [name, times] : stages) fmt::print("{:<20} {:8.2f} ms\n", name, median(times));
  fmt::print(
      "{} triangles, {} clusters: sm {:.1f} ms, bare {:.1f} ms, ratio {:.3f}; with the camera pass {:.3f} of the "
      "camera pass alone\n",
      scene_gpu.triangle_count(), scene_gpu.cluster_count(), median(ours), median(theirs),
      median(ours) / median(theirs), (median(cameras) + median(ours)) / median(cameras));
}
