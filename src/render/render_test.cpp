#include <algorithm>
#include <cmath>
#include <random>

#include "gpu/device_for_test.h"
#include "render/shared.h"
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

TEST(PictureTest, VisibilityIsGrey) {
  const std::vector<float> visibility{0, 1, 0.5f};
  const Picture picture = to_picture(visibility, 3, 1);
  EXPECT_EQ(picture.pixels, (std::vector<glm::u8vec4>{{0, 0, 0, 255}, {255, 255, 255, 255}, {128, 128, 128, 255}}));
}

}  // namespace
}  // namespace shadewright::render
