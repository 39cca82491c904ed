// The drawing of sub-pixel maps against an exact test of coverage, and what their shadows do as the light moves.
#include "shadow/storage/subpixel/subpixel.h"

#include <algorithm>
#include <array>
#include <random>
#include <set>

#include "gpu/device_for_test.h"
#include "shadewright/scene/builtin.h"
#include "shadow/view_for_test.h"

namespace shadewright::shadow {
namespace {

constexpr uint32_t width = 160, height = 120;

/// How many pixels of a view are in the shadow of `light`.
size_t count_shadowed(ViewForTest& view, Technique& technique, const Light& light) {
  view.frame().light = light;
  return static_cast<size_t>(std::ranges::count(view.look_up(technique), std::byte{0}));
}

std::unique_ptr<Technique> make(const gpu::Device& device, const char* spec) {
  return make_technique(device, parse_spec(spec), {width, height});
}

/// Each mesh shown once.
Scene scene_of(std::vector<Mesh> meshes) {
  Scene scene;
  scene.meshes = std::move(meshes);
  scene.instances.resize(scene.meshes.size());
  for (uint32_t i = 0; i < scene.instances.size(); ++i) scene.instances[i].mesh = i;
  return scene;
}

class SubpixelTest : public gpu::DeviceTest {};

using Triangle = std::array<glm::dvec2, 3>;

/// Whether a triangle, however thin, and the square around `centre` overlap: no axis separates them.
bool touches(const Triangle& triangle, const glm::dvec2& centre, double half) {
  std::vector<glm::dvec2> axes{{1, 0}, {0, 1}};
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec2 edge = triangle[(i + 1) % 3] - triangle[i];
    if (edge != glm::dvec2(0)) axes.emplace_back(-edge.y, edge.x);
  }
  return std::all_of(axes.begin(), axes.end(), [&](const glm::dvec2& axis) {
    double low = 1e300, high = -1e300;
    for (const glm::dvec2& corner : triangle) {
      low = std::min(low, glm::dot(axis, corner - centre));
      high = std::max(high, glm::dot(axis, corner - centre));
    }
    const double reach = half * (std::abs(axis.x) + std::abs(axis.y));
    return low <= reach && high >= -reach;
  });
}

/// Three kinds in turn: any, slivers, and such as the light sees edge-on.
Mesh random_triangles(std::mt19937& random, const glm::dvec3& to_light) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  Mesh mesh;
  for (uint32_t t = 0; t < 18; ++t) {
    const double size = std::pow(10.0, unit(random) - 1);
    const glm::dvec3 a = vector(), b = a + size * vector();
    const glm::dvec3 c = t % 3 == 0   ? a + size * vector()
                         : t % 3 == 1 ? glm::mix(a, b, unit(random)) + 1e-4 * vector()
                                      : glm::mix(a, b, unit(random)) + unit(random) * size * to_light;
    for (const glm::dvec3& corner : {a, b, c}) mesh.positions.emplace_back(corner);
    mesh.triangles.emplace_back(3 * t, 3 * t + 1, 3 * t + 2);
  }
  return mesh;
}

/// Every texel that a triangle touches is written, and none that all of them miss by more than the rounding of
/// vertices.
TEST_F(SubpixelTest, WritesExactlyTheTexelsThatTrianglesTouch) {
  const unsigned seed = 2014;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  constexpr double rounding = 1.0 / 256 + 2e-3;  // texels
  size_t touched = 0;
  for (int round = 0; round < 6; ++round) {
    const Light light = sun(20 + 43 * round, 25 + 7 * round);
    const Scene scene = scene_of({random_triangles(random, -light.direction)});
    const auto technique = make(device(), round % 2 == 0 ? "spsm@96,fit=scene" : "spsm@40,fit=scene");
    ViewForTest view(device(), scene, default_camera(scene), width, height);
    count_shadowed(view, *technique, light);
    const Picture map = technique->debug_picture("shadow-map");
    const glm::dvec2 size(map.width, map.height);
    std::vector<Triangle> triangles;
    const Mesh& mesh = scene.meshes.front();
    for (const glm::uvec3& corners : mesh.triangles) {
      Triangle triangle;
      for (int k = 0; k < 3; ++k) {
        const glm::dvec4 clip =
            technique->views().front().light_from_world * glm::dvec4(glm::dvec3(mesh.positions[corners[k]]), 1);
        triangle[static_cast<size_t>(k)] = (0.5 * glm::dvec2(clip) / clip.w + 0.5) * size;
      }
      triangles.push_back(triangle);
    }
    const auto any_touches = [&](const glm::dvec2& centre, double half) {
      return std::any_of(triangles.begin(), triangles.end(),
                         [&](const Triangle& triangle) { return touches(triangle, centre, half); });
    };
    for (uint32_t y = 0; y < map.height; ++y)
      for (uint32_t x = 0; x < map.width; ++x) {
        const bool written = map.pixels[size_t{y} * map.width + x].r != 0;
        const glm::dvec2 centre(x + 0.5, y + 0.5);
        if (any_touches(centre, 0.5 - 1e-3)) {
          ++touched;
          EXPECT_TRUE(written) << "round " << round << ", texel " << x << ", " << y;
        } else if (!any_touches(centre, 0.5 + 2 * rounding)) {
          EXPECT_FALSE(written) << "round " << round << ", texel " << x << ", " << y;
        }
      }
  }
  EXPECT_GT(touched, 1000u);
}

/// Small triangles are rasterized by a compute pass where the device can, and the map is the same bits.
TEST_F(SubpixelTest, MapsAreTheSameWithoutWideAtomics) {
  ASSERT_TRUE(device().has_wide_atomics());
  const gpu::Device plain(gpu::DeviceOptions{"", true, false});
  ASSERT_FALSE(plain.has_wide_atomics());
  std::mt19937 random(64);
  const Light light = sun(50, 40);
  std::vector<Mesh> meshes;
  for (int i = 0; i < 40; ++i) meshes.push_back(random_triangles(random, -light.direction));
  const Scene scene = scene_of(std::move(meshes));
  struct Result {
    std::vector<std::byte> first, second;
    Picture map;
    uint64_t small_bytes = 0;
  };
  const auto draw = [&](const gpu::Device& on, const char* spec) {
    ViewForTest view(on, scene, default_camera(scene), width, height);
    view.frame().light = light;
    const auto technique = make(on, spec);
    Result result{view.look_up(*technique), view.look_up(*technique), technique->debug_picture("shadow-map"), 0};
    for (const Allocation& allocation : technique->allocations())
      if (allocation.name == "small casters") result.small_bytes = allocation.bytes;
    return result;
  };
  for (const char* spec : {"spsm@96,fit=scene", "spsm@250", "perspective/subpixel/hard@96",
                           "cascaded/subpixel/hard@64,cascades=3", "spsm@96,slopes=power"}) {
    SCOPED_TRACE(spec);
    const Result by_compute = draw(device(), spec), by_geometry = draw(plain, spec);
    EXPECT_GT(by_compute.small_bytes, 0u);
    EXPECT_EQ(by_geometry.small_bytes, 0u);
    EXPECT_EQ(by_compute.first, by_geometry.first);
    EXPECT_EQ(by_compute.second, by_compute.first);
    EXPECT_TRUE(std::ranges::equal(by_compute.map.pixels, by_geometry.map.pixels));
    EXPECT_GT(std::ranges::count(by_compute.first, std::byte{0}), 100);
  }
  EXPECT_TRUE(plain.validation_messages().empty());
}

/// Buffers of the device begin with what the memory held before: of instances that culling leaves out, nothing else is
/// ever written.
TEST_F(SubpixelTest, MapsDoNotDependOnWhatMemoryHeld) {
  const Scene scene = make_builtin("city");
  ViewForTest view(device(), scene, scene.cameras.front(), width, height);
  view.frame().light = scene.lights.front();
  std::set<std::vector<std::byte>> answers;
  for (const std::byte held : {std::byte{0}, std::byte{0xff}, std::byte{0}, std::byte{0xff}}) {
    for (size_t bytes = 256; bytes <= (size_t{1} << 20); bytes += bytes / 8) {
      const std::vector<std::byte> freed(bytes, held);
      ASSERT_EQ(std::ranges::count(freed, held), static_cast<std::ptrdiff_t>(bytes));
    }
    answers.insert(view.look_up(*make(device(), "cascaded/subpixel/hard@256")));
  }
  EXPECT_EQ(answers.size(), 1u);
}

Mesh box(const glm::vec3& low, const glm::vec3& high) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// The shadow of a bar's end grows as the light sinks, by steps far below a texel.
TEST_F(SubpixelTest, ShadowsGrowMonotonicallyAsTheLightSweeps) {
  const Scene scene = scene_of({box({-6, -0.2f, -6}, {6, 0, 6}), box({-8, 1, -0.5f}, {0.013f, 1.2f, 0.517f})});
  Camera camera;
  camera.eye = {0.7, 0.8, 2.4};
  camera.target = {0.9, 0, 0};
  ViewForTest view(device(), scene, camera, width, height);
  for (const char* spec : {"spsm@64,fit=scene", "uniform/subpixel/aa@64,fit=scene"}) {
    SCOPED_TRACE(spec);
    const auto technique = make(device(), spec);
    // A texel is 12 / 64 metres or more; the bar's end moves by a tenth of that a step.
    size_t before = 0, first = 0, steps = 0;
    for (int step = 0; step < 24; ++step) {
      const double slope = 0.5 + step * 0.019;  // of the light: what it travels along x a metre down
      Light light;
      light.direction = glm::normalize(glm::dvec3(slope, -1, 0));
      const size_t shadowed = count_shadowed(view, *technique, light);
      if (step == 0) first = shadowed;
      EXPECT_GE(shadowed + 2, before) << "step " << step;  // pixels on the border of both frames
      steps += shadowed > before;
      before = shadowed;
    }
    EXPECT_GT(first, 100u);
    EXPECT_GE(steps, 22u);
  }
}

/// Where a pixel is smaller than a texel, smoothing keeps it on the side of one half that its middle is on, and tells
/// how much of the pixel the shadow covers in finer steps than a few samples would.
TEST_F(SubpixelTest, SmoothingKeepsTheSideOfAPixelsMiddle) {
  const Scene scene = scene_of({box({-6, -0.2f, -6}, {6, 0, 6}), box({-8, 1, -0.5f}, {0.013f, 1.2f, 0.517f}),
                                box({-0.9f, 0.4f, -3}, {-0.6f, 0.5f, 3})});
  Camera camera;
  camera.eye = {0.7, 2.1, 2.4};
  camera.target = {0.2, 0, 0};
  ViewForTest view(device(), scene, camera, width, height);
  view.frame().light = sun(35, 52);
  const auto hard = view.look_up(*make(device(), "spsm@64,fit=scene"));
  const auto smooth = view.look_up(*make(device(), "uniform/subpixel/aa@64,fit=scene"));
  std::set<std::byte> levels;
  size_t shadowed = 0;
  for (size_t i = 0; i < hard.size(); ++i) {
    EXPECT_EQ(smooth[i] >= std::byte{128}, hard[i] != std::byte{0}) << "pixel " << i % width << ", " << i / width;
    shadowed += hard[i] == std::byte{0};
    levels.insert(smooth[i]);
  }
  EXPECT_GT(shadowed, 500u);
  EXPECT_GT(levels.size(), 100u);
}

}  // namespace
}  // namespace shadewright::shadow
