#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include "gpu/device_for_test.h"
#include "render/shared.h"
#include "shaders/camera_vert.h"
#include "shadewright/error.h"
#include "shadewright/geometry/projection.h"
#include "shadewright/raytrace/tracer.h"
#include "shadewright/render/camera_pass.h"
#include "shadewright/render/image.h"
#include "shadewright/scene/builtin.h"

namespace shadewright::render {
namespace {

constexpr uint32_t width = 480, height = 270;

class RenderTest : public gpu::DeviceTest {
 protected:
  std::vector<SurfacePoint> draw(const Scene& scene, const CameraView& view) {
    const SceneGpu scene_gpu(device(), scene);
    CameraPass pass(scene_gpu, view.width, view.height, false);
    gpu::Recorder recorder(device());
    pass.record(recorder, view);
    recorder.finish();
    return pass.surface_points(view);
  }

  /// Coverage, depth and normals of the camera pass against primary rays; silhouette pixels excepted for depth and
  /// normals.
  void expect_agreement(const Scene& scene, const Camera& camera) {
    const double near = near_distance(scene, camera);
    const CameraView view = make_view(camera, near, width, height);
    const auto points = draw(scene, view);
    const auto hits = Tracer(scene).primary({width, height, camera}, near);
    const glm::dvec3 axis = glm::normalize(camera.target - camera.eye);
    const auto background = [&](size_t i) { return hits[i].distance == 0; };
    size_t coverage = 0, depth = 0, normal = 0, covered = 0;
    for (uint32_t y = 1; y + 1 < height; ++y)
      for (uint32_t x = 1; x + 1 < width; ++x) {
        const size_t i = size_t{y} * width + x;
        coverage += points[i].valid() == background(i);
        const size_t around[] = {i, i - 1, i + 1, i - width, i + width};
        const bool one_triangle = std::all_of(std::begin(around), std::end(around), [&](size_t j) {
          return hits[j].triangle == hits[i].triangle && hits[j].instance == hits[i].instance;
        });
        if (background(i) || !points[i].valid() || !one_triangle) continue;
        ++covered;
        const double view_depth = glm::dot(glm::dvec3(points[i].position) - camera.eye, axis);
        depth += std::abs(view_depth - static_cast<double>(hits[i].distance)) > 1e-4 * view_depth;
        normal += glm::dot(points[i].normal, hits[i].normal) < 0.999999f;
      }
    EXPECT_GT(covered, width * height / 20) << scene.name;
    EXPECT_LE(static_cast<double>(coverage), 1e-3 * width * height) << scene.name;
    EXPECT_LE(static_cast<double>(depth), 1e-4 * static_cast<double>(covered)) << scene.name;
    EXPECT_LE(static_cast<double>(normal), 1e-4 * static_cast<double>(covered)) << scene.name;
  }
};

TEST_F(RenderTest, CameraPassAgreesWithPrimaryRays) {
  for (const char* name : {"sandbox", "city", "chess", "spheres", "furball"}) {
    const Scene scene = make_builtin(name);
    expect_agreement(scene, scene.cameras.front());
  }
}

TEST_F(RenderTest, MirroredAndSkewedInstancesKeepTheirNormals) {
  Scene scene = make_builtin("sandbox");
  for (size_t i = 0; i < scene.instances.size(); i += 2) {
    glm::dmat4 skew(1.0);
    skew[0][0] = -1.3;
    skew[1][0] = 0.4;
    skew[2][2] = 0.6;
    scene.instances[i].world_from_mesh = skew * scene.instances[i].world_from_mesh;
  }
  expect_agreement(scene, scene.cameras.front());
}

TEST_F(RenderTest, NothingInSightIsBackground) {
  const Scene scene = make_builtin("spheres");
  Camera camera = scene.cameras.front();
  camera.target = camera.eye + glm::dvec3(0, 1, 0.001);
  camera.eye.y += 1000;
  camera.target.y += 1000;
  for (const SurfacePoint& point : draw(scene, make_view(camera, 0.1, 64, 64))) EXPECT_FALSE(point.valid());
}

TEST(CameraViewTest, ReadsEveryConventionOffTheMatrix) {
  Camera camera;
  camera.eye = {3, 4, -5};
  camera.target = {0, 1, 2};
  const CameraView reversed = make_view(camera, 0.1, width, height);
  // Standard depth with a finite far plane, and a jitter of a third of a pixel.
  const double tangent = std::tan(0.5 * camera.fov_y), aspect = static_cast<double>(width) / height;
  const glm::dmat4 view = look_along(camera.eye, camera.target - camera.eye, camera.up);
  CameraView standard = reversed;
  standard.clip_from_world =
      perspective_window({-tangent * aspect, -tangent}, {tangent * aspect, tangent}, 0.1, 500) * view;
  standard.background_depth = 1;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> pixel_x(0, width), pixel_y(0, height), distance(0.5, 400);
  EXPECT_LT(glm::distance(standard.eye(), camera.eye), 1e-9);
  for (int i = 0; i < 100; ++i) {
    const glm::dvec2 pixel(pixel_x(random), pixel_y(random));
    const double view_depth = distance(random);
    EXPECT_LT(glm::distance(standard.ray(pixel), reversed.ray(pixel)), 1e-9);
    const glm::dvec3 point = camera.eye + reversed.ray(pixel) * view_depth;
    for (const CameraView& convention : {reversed, standard}) {
      const glm::dvec4 clip = convention.clip_from_world * glm::dvec4(point, 1);
      const shared::CameraData data = camera_data(convention);
      const double depth = clip.z / clip.w;
      EXPECT_NEAR(static_cast<double>(data.depth_offset) / (depth - static_cast<double>(data.depth_scale)), view_depth,
                  1e-4 * view_depth + 2e-6 * view_depth * view_depth / 0.1);
    }
  }
}

TEST(CameraViewTest, RefusesOrthographicCameras) {
  CameraView view;
  view.clip_from_world = orthographic({{-1, -1, -10}, {1, 1, 0}});
  EXPECT_THROW(camera_data(view), InputError);
}

TEST_F(RenderTest, FrontToBackIsAPermutationByDistance) {
  const Scene scene = make_builtin("city");
  const SceneGpu scene_gpu(device(), scene);
  auto order = scene_gpu.front_to_back(scene.cameras.front().eye);
  std::sort(order.begin(), order.end());
  for (uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
}

/// Instances of the device as bytes.
std::vector<std::byte> instance_bytes(const gpu::Device& device, const SceneGpu& scene) {
  return gpu::read_back(device, scene.instances(), scene.instance_bounds().size() * sizeof(shared::InstanceData));
}

TEST_F(RenderTest, UpdatedSceneEqualsOneMadeAtThatTime) {
  for (const char* name : {"street", "characters"}) {
    const Scene scene = make_builtin(name);
    SceneGpu updated(device(), scene, 0, 2);
    EXPECT_EQ(updated.update_count(), 0u);
    uint32_t slot = 0;
    for (const double time : {1.7, 0.4, 100.0}) {
      const std::vector<Box> before(updated.instance_bounds().begin(), updated.instance_bounds().end());
      gpu::Recorder recorder(device());
      updated.update(scene, time, slot, recorder);
      recorder.finish();
      slot = 1 - slot;
      const SceneGpu made(device(), scene, time);
      SCOPED_TRACE(std::string(name) + " at " + std::to_string(time));
      EXPECT_EQ(instance_bytes(device(), updated), instance_bytes(device(), made));
      EXPECT_EQ(updated.bounds().min, made.bounds().min);
      EXPECT_EQ(updated.bounds().max, made.bounds().max);
      EXPECT_EQ(updated.front_to_back({1, 2, 3}), made.front_to_back({1, 2, 3}));
      ASSERT_FALSE(updated.moved().empty());
      std::vector<uint8_t> moved(scene.instances.size(), 0);
      for (const MovedInstance& m : updated.moved()) {
        moved[m.instance] = 1;
        EXPECT_TRUE(scene.instances[m.instance].motion.has_value());
        EXPECT_EQ(m.before.min, before[m.instance].min);
        EXPECT_EQ(m.before.max, before[m.instance].max);
      }
      for (size_t i = 0; i < scene.instances.size(); ++i) {
        EXPECT_EQ(updated.instance_bounds()[i].min, made.instance_bounds()[i].min);
        EXPECT_EQ(updated.instance_bounds()[i].max, made.instance_bounds()[i].max);
        if (!moved[i]) {
          EXPECT_EQ(updated.instance_bounds()[i].min, before[i].min);
        }
      }
    }
    EXPECT_EQ(updated.update_count(), 3u);
    gpu::Recorder recorder(device());
    updated.update(scene, 1000.0, 0, recorder);  // past the last key, as before: nothing moves
    recorder.finish();
    EXPECT_TRUE(updated.moved().empty());
  }
}

TEST_F(RenderTest, FiltersDrawMovingOrUnmovingInstances) {
  const Scene scene = make_builtin("street");
  const SceneGpu scene_gpu(device(), scene);
  CulledDraws draws(scene_gpu, 1, 1, "test");
  gpu::Image depth(device(), {"depth", vk::Format::eD32Sfloat, width, height, 1,
                              vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eTransferSrc});
  gpu::Buffer camera(device(), "camera", sizeof(shared::CameraData), gpu::HostAccess::write);
  const Camera& eye = find_camera(scene, "overview");
  const CameraView view = make_view(eye, near_distance(scene, eye), width, height);
  camera.mapped<shared::CameraData>()[0] = camera_data(view);
  gpu::GraphicsDesc desc;
  desc.vertex = shaders::camera_vert;
  desc.kinds = {gpu::BindingKind::storage_buffer, gpu::BindingKind::uniform_buffer};
  CulledDraws::set_vertex_input(desc, SceneInputs::surface);
  desc.depth_compare = vk::CompareOp::eGreater;
  const gpu::GraphicsPass pass(device(), desc);
  const auto depth_of = [&](InstanceFilter filter) {
    const std::array planes{view.planes()};
    draws.set_views(0, planes, {}, filter);
    gpu::submit_and_wait(device(), [&](const vk::raii::CommandBuffer& commands) {
      draws.cull(commands, 0);
      gpu::memory_barrier(commands);
      depth.transition(commands, vk::ImageLayout::eDepthAttachmentOptimal, true);
      const vk::RenderingAttachmentInfo target(depth.view(), vk::ImageLayout::eDepthAttachmentOptimal, {}, {}, {},
                                               vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
                                               vk::ClearDepthStencilValue(0, 0));
      const vk::Rect2D area({0, 0}, depth.extent());
      vk::RenderingInfo rendering({}, area, 1);
      rendering.pDepthAttachment = &target;
      commands.beginRendering(rendering);
      commands.setViewport(0, vk::Viewport(0, 0, width, height, 0, 1));
      commands.setScissor(0, area);
      const gpu::Binding bindings[] = {gpu::Binding::storage(scene_gpu.triangle_normals()),
                                       gpu::Binding::uniform(camera)};
      pass.bind(commands, bindings, {});
      draws.draw(commands, 0);
      commands.endRendering();
    });
    const auto bytes = gpu::read_back(device(), depth, sizeof(float));
    std::vector<float> values(bytes.size() / sizeof(float));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  };
  const auto all = depth_of(InstanceFilter::all), moving = depth_of(InstanceFilter::moving),
             unmoving = depth_of(InstanceFilter::unmoving);
  size_t moving_in_front = 0;
  for (size_t i = 0; i < all.size(); ++i) {
    ASSERT_EQ(all[i], std::max(moving[i], unmoving[i])) << i;
    moving_in_front += moving[i] > unmoving[i];
  }
  EXPECT_GT(moving_in_front, 100u);
  EXPECT_LT(moving_in_front, all.size() / 2);
}

TEST(PictureTest, VisibilityIsGrey) {
  const std::vector<float> visibility{0, 1, 0.5f};
  const Picture picture = to_picture(visibility, 3, 1);
  EXPECT_EQ(picture.pixels, (std::vector<glm::u8vec4>{{0, 0, 0, 255}, {255, 255, 255, 255}, {128, 128, 128, 255}}));
}

}  // namespace
}  // namespace shadewright::render
