// The bound of a surface point's float error, against a camera pass's arithmetic done in float on random triangles; and
// what it is for: shadow rays from such points neither hit the surface they start from nor miss what touches it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "raytrace/pixel_rays.h"
#include "shadewright/geometry/projection.h"
#include "shadewright/raytrace/tracer.h"

namespace shadewright {
namespace {

constexpr uint64_t seed = 20140509;

class Random {
 public:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  /// Between `low` and `high`, each power of ten as often as the next.
  double logarithmic(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  glm::dvec3 direction() {
    glm::dvec3 v;
    do v = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    while (glm::length(v) > 1 || glm::length(v) < 0.1);
    return glm::normalize(v);
  }
  glm::dmat3 rotation() { return glm::dmat3(glm::angleAxis(uniform(0, 6), direction())); }

 private:
  std::mt19937_64 engine_{seed};
};

struct Corner {
  float x, y, depth;  // image position in pixels, depth = near / w
};

// A value given at three corners, interpolated as a plane over the image in float.
float interpolate(const std::array<Corner, 3>& c, float x, float y) {
  const float x01 = c[0].x - c[1].x, y01 = c[0].y - c[1].y, x20 = c[2].x - c[0].x, y20 = c[2].y - c[0].y;
  const float over_area = 1.0f / (x01 * y20 - x20 * y01);
  const float d01 = c[0].depth - c[1].depth, d20 = c[2].depth - c[0].depth;
  const float dx = (d01 * y20 - d20 * y01) * over_area, dy = (d20 * x01 - d01 * x20) * over_area;
  return c[0].depth - (dx * c[0].x + dy * c[0].y) + dx * x + dy * y;
}

bool covers(const std::array<Corner, 3>& c, double x, double y) {
  std::array<double, 3> side{};
  for (size_t i = 0; i < 3; ++i) {
    const Corner &a = c[i], &b = c[(i + 1) % 3];
    side[i] = (double{b.x} - a.x) * (y - a.y) - (double{b.y} - a.y) * (x - a.x);
  }
  return std::ranges::all_of(side, [](double s) { return s > 0; }) ||
         std::ranges::all_of(side, [](double s) { return s < 0; });
}

TEST(PositionError, BoundsTheErrorOfACameraPass) {
  Random random;
  size_t checked = 0;
  for (const double scale : {1e-3, 1.0, 1e3, 1e5})
    for (int round = 0; round < 6000; ++round) {
      // A triangle of a scene of this scale, seen from anywhere between grazing and frontal, near and far.
      const glm::dvec3 center = random.direction() * random.uniform(0, 10) * scale;
      const double size = scale * random.logarithmic(1e-3, 1);
      std::array<glm::vec3, 3> triangle;
      for (glm::vec3& p : triangle) p = glm::vec3(center + size * random.direction());
      const glm::dvec3 a(triangle[0]), b(triangle[1]), c(triangle[2]);
      const glm::dvec3 cross = glm::cross(b - a, c - a);
      if (glm::length(cross) < 1e-6 * size * size) continue;
      const glm::dvec3 normal = glm::normalize(cross);
      const double distance = scale * random.logarithmic(1e-3, 10), elevation = random.logarithmic(1e-3, 1.5);
      const glm::dvec3 target = (a + b + c) / 3.0, along = glm::normalize(glm::cross(normal, random.direction()));
      PixelGrid grid{.width = 1920, .height = 1080, .camera = {}};
      grid.camera.eye = target + distance * (std::sin(elevation) * normal + std::cos(elevation) * along);
      grid.camera.target = target + 0.3 * distance * random.direction();
      const double near = 1e-4 * distance;

      const glm::dvec3 eye = grid.camera.eye;
      const glm::mat4 clip_from_world(perspective_reversed_infinite(grid.camera.fov_y, 1920.0 / 1080.0, near) *
                                      look_along(eye, grid.camera.target - eye, grid.camera.up));
      std::array<Corner, 3> corners;
      bool on_screen = true;
      for (size_t i = 0; i < 3; ++i) {
        const glm::vec4 clip = clip_from_world * glm::vec4(triangle[i], 1.0f);
        const float over_w = 1.0f / clip.w;
        corners[i] = {(clip.x * over_w * 0.5f + 0.5f) * 1920.0f, (clip.y * over_w * 0.5f + 0.5f) * 1080.0f,
                      clip.z * over_w};
        on_screen = on_screen && clip.w > near && std::abs(clip.x) < 2 * clip.w && std::abs(clip.y) < 2 * clip.w;
      }
      if (!on_screen) continue;
      const auto [min_x, max_x] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
      const auto [min_y, max_y] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
      const PixelRays rays(grid);
      for (int sample = 0; sample < 16; ++sample) {
        const double x = std::floor(random.uniform(min_x, max_x)) + 0.5,
                     y = std::floor(random.uniform(min_y, max_y)) + 0.5;
        if (!covers(corners, x, y)) continue;
        const float depth = interpolate(corners, static_cast<float>(x), static_cast<float>(y));
        const glm::vec3 point = glm::vec3(eye) + glm::vec3(rays(x, y)) * (static_cast<float>(near) / depth);
        const double off_plane = std::abs(glm::dot(normal, glm::dvec3(point) - a));
        EXPECT_LT(off_plane, position_error(point, glm::vec3(eye))) << "seed " << seed << ", scale " << scale;
        ++checked;
      }
    }
  EXPECT_GT(checked, 10000u);
}

// A box with half extents `half`, turned and moved, as 12 triangles.
Scene turned_box(const glm::dvec3& half, const glm::dmat3& rotation, const glm::dvec3& center) {
  Mesh mesh;
  for (unsigned i = 0; i < 8; ++i) mesh.positions.push_back({i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  Scene scene;
  scene.meshes = {mesh};
  scene.instances.resize(1);
  glm::dmat4& world_from_mesh = scene.instances[0].world_from_mesh;
  for (int axis = 0; axis < 3; ++axis) world_from_mesh[axis] = glm::dvec4(rotation[axis] * half[axis], 0.0);
  world_from_mesh[3] = glm::dvec4(center, 1.0);
  return scene;
}

struct Face {
  glm::dvec3 normal, center, u, v;  // u, v: half edges
};

std::vector<Face> faces(const Scene& box) {
  const glm::dmat4 m = box.instances[0].world_from_mesh;
  std::vector<Face> result;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const glm::dvec3 out = side * glm::dvec3(m[axis]);
      result.push_back(
          {glm::normalize(out), glm::dvec3(m[3]) + out, glm::dvec3(m[(axis + 1) % 3]), glm::dvec3(m[(axis + 2) % 3])});
    }
  return result;
}

// Off the plane by up to the bound less the rounding of the float point itself, which is within the bound too.
glm::vec3 noisy(Random& random, const glm::dvec3& p, const glm::dvec3& normal, const glm::vec3& eye) {
  return glm::vec3(p + 0.6 * random.uniform(-1, 1) * double{position_error(glm::vec3(p), eye)} * normal);
}

TEST(PositionError, ConvexBodyHasNoShadowOnItself) {
  Random random;
  for (const double scale : {1e-3, 1.0, 1e3, 1e5})
    for (int round = 0; round < 60; ++round) {
      const glm::dvec3 half(random.logarithmic(0.1, 1), random.logarithmic(0.1, 1), random.logarithmic(0.1, 1));
      const glm::dvec3 away = random.direction() * (round % 3 == 0 ? 10.0 : 1.0);
      const Scene scene = turned_box(scale * half, random.rotation(), scale * away);
      const Tracer tracer(scene);
      for (const Face& face : faces(scene)) {
        Light light;  // from grazing to frontal
        const double elevation = random.logarithmic(1e-3, 1.5);
        light.direction = -(std::sin(elevation) * face.normal +
                            std::cos(elevation) * glm::normalize(glm::cross(face.normal, random.direction())));
        const glm::dvec3 seen = face.center + random.uniform(-1, 1) * face.u + random.uniform(-1, 1) * face.v;
        const glm::vec3 eye(seen + scale * random.logarithmic(1e-4, 10) * face.normal);
        std::vector<SurfacePoint> points;
        for (int i = 0; i < 200; ++i) {
          const glm::dvec3 p = face.center + random.uniform(-1, 1) * face.u + random.uniform(-1, 1) * face.v;
          points.push_back({noisy(random, p, face.normal, eye), glm::vec3(face.normal)});
        }
        const std::vector<uint8_t> lit = tracer.visible(points, eye, light);
        EXPECT_EQ(std::ranges::count(lit, 0), 0)
            << "seed " << seed << ", scale " << scale << ", elevation " << elevation << ", distance "
            << glm::distance(seen, glm::dvec3(eye)) / scale;
      }
    }
}

// Close to a triangle far larger than the view, whose own float arithmetic is coarser than the point's.
TEST(PositionError, LargeTriangleHasNoShadowOnItself) {
  Random random;
  for (int round = 0; round < 400; ++round) {
    const glm::dmat3 rotation = random.rotation();
    Scene scene;
    scene.meshes.resize(1);
    for (int i = 0; i < 3; ++i)
      scene.meshes[0].positions.push_back(glm::vec3(rotation * glm::dvec3(std::cos(2.1 * i), 0, std::sin(2.1 * i))));
    scene.meshes[0].triangles = {{0, 2, 1}};
    scene.instances.resize(1);
    const Tracer tracer(scene);
    const std::vector<glm::vec3>& corner = scene.meshes[0].positions;
    const glm::dvec3 a(corner[0]), b(corner[1]), c(corner[2]), normal = glm::normalize(glm::cross(c - a, b - a));
    const double view = random.logarithmic(1e-5, 1e-1), elevation = random.logarithmic(1e-3, 1.5);
    const glm::vec3 eye(view * normal);
    Light light;
    light.direction =
        -(std::sin(elevation) * normal + std::cos(elevation) * glm::normalize(glm::cross(normal, random.direction())));
    std::vector<SurfacePoint> points;
    for (int i = 0; i < 100; ++i) {
      glm::dvec3 p = view * random.uniform(0, 1) * glm::cross(normal, random.direction());
      p -= normal * glm::dot(normal, p - a);
      points.push_back({noisy(random, p, normal, eye), glm::vec3(normal)});
    }
    const std::vector<uint8_t> lit = tracer.visible(points, eye, light);
    EXPECT_EQ(std::ranges::count(lit, 0), 0) << "seed " << seed << ", round " << round;
  }
}

// A wall stands on a turned plane: right behind it there is shadow, from the distance on that the offset leaves open.
TEST(PositionError, ShadowStartsAtTheContact) {
  Random random;
  for (const double scale : {1e-3, 1.0, 1e3, 1e5})
    for (int round = 0; round < 60; ++round) {
      const glm::dmat3 rotation = random.rotation();
      const glm::dvec3 center = random.direction() * scale;
      Scene scene = turned_box(scale * glm::dvec3(1, 0.1, 1), rotation, center);
      const Scene wall = turned_box(scale * glm::dvec3(0.1, 0.4, 0.9), rotation, center + rotation[1] * (0.5 * scale));
      scene.instances.push_back(wall.instances[0]);
      const Tracer tracer(scene);
      const glm::dvec3 up = rotation[1], behind = rotation[0];
      const double elevation = random.uniform(0.1, 0.6);
      Light light;
      light.direction = std::cos(elevation) * behind - std::sin(elevation) * up;
      const glm::vec3 eye(center + scale * (up + 2.0 * behind));
      std::vector<SurfacePoint> points;
      for (int i = 0; i < 100; ++i) {
        const glm::dvec3 foot = center + scale * (0.1 * up + 0.1 * behind + random.uniform(-0.8, 0.8) * rotation[2]);
        // Three offsets along the plane: one each for the point's error, the ray's origin and the wall's own rounding.
        const double gap = 3 * double{position_error(glm::vec3(foot), eye)} / std::tan(elevation);
        const glm::dvec3 p = foot + behind * gap * random.logarithmic(1, 10);
        points.push_back({noisy(random, p, up, eye), glm::vec3(up)});
      }
      const std::vector<uint8_t> lit = tracer.visible(points, eye, light);
      EXPECT_EQ(std::ranges::count(lit, 1), 0) << "seed " << seed << ", scale " << scale;
    }
}

}  // namespace
}  // namespace shadewright
