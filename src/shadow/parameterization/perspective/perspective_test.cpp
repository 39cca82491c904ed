// The matrices of perspective maps, on the CPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>

#include "shadewright/geometry/projection.h"
#include "shadewright/raytrace/tracer.h"
#include "shadewright/scene/builtin.h"
#include "shadow/parameterization/perspective/random_pairs_for_test.h"
#include "shadow/parameterization/perspective/shadowable.h"
#include "shadow/parameterization/perspective/warp.h"

namespace shadewright::shadow {
namespace {

constexpr uint32_t width = 96, height = 72;

Camera level_camera() {
  Camera camera;
  camera.eye = {0, 2, 0};
  camera.target = {0, 2, -1};
  return camera;
}

/// What the camera would see of `points` (nothing hides another), as the device reports it: one tile a pixel.
Receivers see(const render::CameraView& view, std::span<const SurfacePoint> points, const Light& light) {
  const TileGrid grid = tile_grid(view.width, view.height);
  std::vector<shared::VisibleTile> tiles(size_t{grid.columns} * grid.rows, {1, 0, 0, 0, {}, {}, {}});
  const CameraMap camera(view);
  const glm::dvec3 axis = glm::normalize(light.direction);
  for (uint32_t y = 0; y < view.height; ++y)
    for (uint32_t x = 0; x < view.width; ++x) {
      const SurfacePoint& point = points[y * view.width + x];
      if (!point.valid()) continue;
      const glm::dvec3 from_light = glm::dvec3(point.position) - light.position;
      double along = 0;
      if (light.kind == LightKind::point)
        along = std::max({std::abs(from_light.x), std::abs(from_light.y), std::abs(from_light.z)});
      if (light.kind == LightKind::spot) {
        along = glm::dot(from_light, axis);
        if (along < std::cos(light.outer_angle) * glm::length(from_light)) continue;
      }
      shared::VisibleTile& tile = tiles[y / grid.side * grid.columns + x / grid.side];
      const auto depth = static_cast<float>(glm::dot(camera.w, glm::dvec4(point.position, 1)));
      const bool first = tile.nearest > tile.farthest;
      tile.nearest = first ? depth : std::min(tile.nearest, depth);
      tile.farthest = std::max(tile.farthest, depth);
      tile.light_distance = first ? float(along) : std::min(tile.light_distance, float(along));
      const auto middle = [&](uint32_t at, uint32_t end) {
        const uint32_t first = at / grid.side * grid.side;
        return (first + std::min(first + grid.side, end)) / 2;
      };
      tile.low = first ? point.position : glm::min(tile.low, point.position);
      tile.high = first ? point.position : glm::max(tile.high, point.position);
      if (x != middle(x, view.width) || y != middle(y, view.height)) continue;
      tile.depth = depth;
      tile.normal = point.normal;
    }
  Receivers receivers = visible_receivers(view, tiles, grid);
  bound(receivers, {});
  return receivers;
}

/// First hits of every pixel.
std::vector<SurfacePoint> trace(const Tracer& tracer, const Camera& camera) {
  const PixelGrid grid{width, height, camera};
  const auto hits = tracer.primary(grid, camera.near);
  std::vector<SurfacePoint> points(hits.size());
  for (size_t i = 0; i < hits.size(); ++i)
    if (hits[i].distance > 0)
      points[i] = {
          glm::vec3(camera.eye + grid.ray(double(i % width) + 0.5, double(i / width) + 0.5) * double(hits[i].distance)),
          hits[i].normal};
  return points;
}

/// What a camera sees of the ground, y = 0, up to `reach`.
std::vector<SurfacePoint> ground_points(const render::CameraView& view, double reach) {
  std::vector<SurfacePoint> points(size_t{view.width} * view.height);
  for (uint32_t y = 0; y < view.height; ++y)
    for (uint32_t x = 0; x < view.width; ++x) {
      const glm::dvec3 ray = view.ray({x + 0.5, y + 0.5});
      const double t = -view.eye().y / ray.y;
      if (ray.y < 0 && t < reach) points[y * view.width + x] = {glm::vec3(view.eye() + t * ray), {0, 1, 0}};
    }
  return points;
}

struct Ground {
  render::CameraView view = render::make_view(level_camera(), 0.01, width, height);
  CameraMap camera{view};
  Receivers seen(const Light& light) const { return see(view, ground_points(view, 60), light); }
};

double spread_of_w(const Projection& projection, const Receivers& receivers) {
  double low = 1e300, high = 0;
  for (const glm::dvec3& p : receivers.hull.points()) {
    const double w = glm::dot(projection.w, glm::dvec4(p, 1));
    low = std::min(low, w);
    high = std::max(high, w);
  }
  return high / low;
}

/// Size of a texel of the map in the image: the root of its area, in any unit.
double texel_in_image(const glm::dmat4& light_from_world, const CameraMap& camera, const ReceiverSample& sample) {
  glm::dvec3 a, b;
  perpendicular_axes(sample.normal, a, b);
  const auto area = [&](const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& w) {
    const auto image = [&](const glm::dvec3& step) {
      const glm::dvec4 p(sample.world + 1e-5 * step, 1);
      return glm::dvec2(glm::dot(x, p), glm::dot(y, p)) / glm::dot(w, p);
    };
    const glm::dvec2 right = image(a) - image(-a), down = image(b) - image(-b);
    return std::abs(right.x * down.y - right.y * down.x);
  };
  return std::sqrt(area(camera.x, camera.y, camera.w) /
                   area(glm::row(light_from_world, 0), glm::row(light_from_world, 1), glm::row(light_from_world, 3)));
}

/// fit=view: a box around the camera reaches from its near plane to a million times as far.
TEST(PerspectiveTest, BoundedReceiversStayInTheirHull) {
  for (const double size : {10.0, 1e3, 1e5}) {
    Frame frame;
    frame.draw_bounds = {{-size, -0.3, -size}, {size, 0.2 * size, size}};
    Camera camera;
    camera.eye = {0, 0, 0};
    camera.target = {0.2, -0.1, -1};
    frame.camera = render::make_view(camera, 0.01, width, height);
    frame.light.direction = glm::normalize(glm::dvec3(1, -1, 0.3));
    Receivers receivers = bounded_receivers(frame);
    bound(receivers, {});
    ASSERT_FALSE(receivers.hull.empty());
    const std::vector<glm::dvec3> points = receiver_points(frame, frame.camera.planes());
    ASSERT_GT(points.size(), 10u);
    for (const Plane& plane : receivers.hull.planes())
      for (const glm::dvec3& point : points) EXPECT_GE(plane.distance(point), -1e-9 * size) << "size " << size;
  }
}

TEST(PerspectiveTest, GroundTexelsHaveEqualImageSizeUnderALightFromAbove) {  // figure 3
  const Ground ground;
  Light light;
  light.direction = {0, -1, 0};
  const Receivers receivers = ground.seen(light);
  const LightFrame frame = light_frames(light).front();
  const auto size_spread = [&](const Projection& projection) {
    const auto matrix = fit_projection(projection, frame, receivers, {512, {}, true, true});
    double low = 1e300, high = 0;
    for (const ReceiverSample& sample : receivers.samples) {
      const double size = texel_in_image(*matrix, ground.camera, sample);
      low = std::min(low, size);
      high = std::max(high, size);
    }
    return high / low;
  };
  EXPECT_NEAR(size_spread(perspective_projection(homogeneous_position(light), ground.camera, receivers, 0)), 1, 1e-3);
  EXPECT_GT(size_spread(uniform_projection(frame)), 4);
}

TEST(PerspectiveTest, LightAlongTheViewAxisIsUniform) {
  const Ground ground;
  // Receivers all over the image, so that their middle is on the axis.
  std::vector<SurfacePoint> points(size_t{width} * height);
  for (uint32_t i = 0; i < points.size(); ++i)
    points[i] = {glm::vec3(ground.view.eye() +
                           (2.0 + 30.0 * ((i * 7919) % 97) / 97) * ground.view.ray({i % width + 0.5, i / width + 0.5})),
                 {0, 0, 1}};
  for (const double sign : {1.0, -1.0}) {
    Light light;
    light.direction = {0, 0, -sign};
    const Receivers receivers = see(ground.view, points, light);
    for (const double shift : {0.0, 5.0})
      EXPECT_NEAR(
          spread_of_w(perspective_projection(homogeneous_position(light), ground.camera, receivers, shift), receivers),
          1, 1e-2);
    const Warp warp = choose_warp(light, light_frames(light).front(), ground.camera, receivers, receivers.hull.bounds(),
                                  {WarpKind::psm, false, 512, true, nullptr, {}});
    EXPECT_LT(warp.gain, 1.05);
    EXPECT_TRUE(choose_warp(light, light_frames(light).front(), ground.camera, receivers, receivers.hull.bounds(),
                            {WarpKind::light_space, false, 512, true, nullptr, {}})
                    .fallback)
        << "lispsm";
  }
}

TEST(PerspectiveTest, MinersHeadLampIsUniform) {
  const Ground ground;
  Light lamp;
  lamp.kind = LightKind::spot;
  lamp.position = ground.view.eye() + glm::dvec3(0, 0.4, 0);
  lamp.direction = {0, 0, -1};
  lamp.outer_angle = 1.0;
  const Receivers receivers = ground.seen(lamp);
  const Projection psm = perspective_projection(homogeneous_position(lamp), ground.camera, receivers, 0);
  const Projection uniform = uniform_projection(light_frames(lamp).front());
  const double scale = glm::length(psm.w) / glm::length(uniform.w);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(psm.w[i], scale * uniform.w[i], 1e-9 * glm::length(psm.w));
}

TEST(PerspectiveTest, WithoutFallbackTheProjectionStaysWhateverItsTexels) {
  const Ground ground;
  const Box scene{{-50, 0, -60}, {50, 20, 50}};
  int fallbacks = 0;
  for (double azimuth = 0; azimuth < 360; azimuth += 15)
    for (const double elevation : {5.0, 30.0, 60.0}) {
      const Light light = sun(azimuth, elevation);
      const LightFrame frame = light_frames(light).front();
      const Receivers receivers = ground.seen(light);
      WarpOptions options{WarpKind::psm, true, 512, true, nullptr, {}};
      if (!choose_warp(light, frame, ground.camera, receivers, scene, options).fallback) continue;
      ++fallbacks;
      options.falls_back = false;
      const Warp warp = choose_warp(light, frame, ground.camera, receivers, scene, options);
      EXPECT_TRUE(warp.drawn && !warp.fallback);
      EXPECT_LE(warp.gain, 1);
      for (const ReceiverSample& sample : receivers.samples) {
        const glm::dvec4 q = warp.light_from_world * glm::dvec4(sample.world, 1.0);
        EXPECT_GT(q.w, 0);
        EXPECT_LE(std::max(std::abs(q.x), std::abs(q.y)), q.w);
      }
    }
  EXPECT_GT(fallbacks, 0);
}

TEST(PerspectiveTest, NothingVisibleIsAViewThatIsNotDrawn) {
  const Ground ground;
  const Light light = sun(30, 40);
  const std::vector<SurfacePoint> sky(size_t{width} * height);
  const Receivers receivers = see(ground.view, sky, light);
  EXPECT_TRUE(receivers.hull.empty());
  EXPECT_FALSE(choose_warp(light, light_frames(light).front(), ground.camera, receivers, {},
                           {WarpKind::best, false, 512, true, nullptr, {}})
                   .drawn);
}

/// H (section 4.1) holds every point between a receiver and the light that is in the scene.
void expect_hull_holds(const std::vector<Plane>& planes, const glm::dvec3& point, double size) {
  for (const Plane& plane : planes) EXPECT_GE(plane.distance(point), -1e-6 * size);
}

struct Tally {
  int views = 0, fallbacks = 0, receivers = 0;
  double log_gain = 0;
};

/// Everything that a view's matrix promises, at each surface point and a random point before it.
void check_view(const Warp& warp, const Light& light, const LightFrame& frame, const render::CameraView& camera,
                const Receivers& receivers, std::span<const SurfacePoint> points, std::span<const uint8_t> ignored,
                const Box& scene, Tally& tally) {
  MapView view;
  view.light_from_world = warp.light_from_world;
  const std::vector<Plane> window = window_planes(frame);
  const std::vector<Plane> hull = hull_planes(receivers.hull, homogeneous_position(light));
  const std::vector<Plane> casters =
      warp.drawn ? caster_planes(view, camera, light, true, warp.reach) : std::vector<Plane>{};
  if (warp.drawn) {
    ++tally.views;
    tally.fallbacks += warp.fallback;
    tally.log_gain += std::log(warp.gain);
    EXPECT_GE(warp.gain, 1);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) ASSERT_TRUE(std::isfinite(warp.light_from_world[i][j]));
    const glm::dmat4 unit = warp.light_from_world * glm::inverse(warp.light_from_world);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) ASSERT_NEAR(unit[i][j], i == j, 1e-4);
  }
  for (size_t i = 0; i < points.size(); ++i) {
    const SurfacePoint& point = points[i];
    if (!point.valid() || (!ignored.empty() && ignored[i] != 0)) continue;
    const glm::dvec3 receiver(point.position);
    const glm::dvec3 to_light =
        light.kind == LightKind::directional ? -scene.diagonal() * light.direction : light.position - receiver;
    if (!(glm::dot(to_light, glm::dvec3(point.normal)) > 0)) continue;
    if (std::any_of(window.begin(), window.end(), [&](const Plane& p) { return p.distance(receiver) <= 0; })) continue;
    if (light.kind == LightKind::spot &&
        glm::dot(-to_light, light.direction) < std::cos(light.outer_angle) * glm::length(to_light))
      continue;
    const bool near_light =
        light.kind != LightKind::directional && glm::length(to_light) < 1e-3 * receivers.hull.bounds().diagonal();
    if (near_light) continue;
    ++tally.receivers;
    ASSERT_TRUE(warp.drawn);
    const glm::dvec4 q = warp.light_from_world * glm::dvec4(receiver, 1);
    ASSERT_GT(q.w, 0);
    ASSERT_LE(std::abs(q.x), q.w * (1 + 1e-7));
    ASSERT_LE(std::abs(q.y), q.w * (1 + 1e-7));
    ASSERT_GE(q.z, -1e-7 * q.w);
    ASSERT_LE(q.z, q.w * (1 + 1e-7));
    const double t = 0.999 * static_cast<double>((i * 2654435761u) % 1000) / 1000 + 1e-3;
    const glm::dvec3 caster = receiver + std::min(t, 0.9995) * to_light;
    const glm::dvec4 c = warp.light_from_world * glm::dvec4(caster, 1);
    ASSERT_GT(c.w, 0);
    ASSERT_NEAR(c.x / c.w, q.x / q.w, 1e-5);
    ASSERT_NEAR(c.y / c.w, q.y / q.w, 1e-5);
    ASSERT_LT(c.z / c.w, q.z / q.w) << "a caster is nearer to the light";
    for (const Plane& plane : casters) ASSERT_GE(plane.distance(caster), -1e-5 * scene.diagonal());
    expect_hull_holds(hull, caster, scene.diagonal());
  }
}

TEST(PerspectiveTest, EdgesAreExpectedAroundSmallCasters) {
  Light light;
  light.direction = glm::normalize(glm::dvec3(0.1, -1, 0.2));
  Receivers receivers = Ground().seen(light);
  const Box roof{{-200, 20, -200}, {200, 21, 200}}, body{{-3, 0, -13}, {3, 0.1, -7}};
  EXPECT_FALSE(keep_shadowable(receivers, light, light_frames(light).front(), std::array{roof, body}));
  float least_near = 1e30f, most_far = 0;
  int near = 0;
  for (const ReceiverSample& sample : receivers.samples) {
    const double distance = glm::distance(sample.world, glm::dvec3(0, 0, -10));
    if (distance < 2) {
      least_near = std::min(least_near, sample.edges);
      ++near;
    }
    if (distance > 9) most_far = std::max(most_far, sample.edges);
  }
  EXPECT_GT(near, 0);
  EXPECT_GT(most_far, 0);
  EXPECT_GT(least_near, 2 * most_far);
}

TEST(PerspectiveTest, AThousandRandomPairsHoldEveryReceiverAndCaster) {
  constexpr unsigned seed = 2002;
  SCOPED_TRACE("seed " + std::to_string(seed));
  const Scene scene = make_builtin("spheres");
  const Tracer tracer(scene);
  const Box bounds = shadewright::bounds(scene);
  RandomPairs pairs(bounds, seed);
  // Where casters are known only what they shadow must be in a map: what the light reaches is ignored.
  std::vector<Box> casters;
  for (const Instance& instance : scene.instances) {
    Box& box = casters.emplace_back();
    for (const glm::vec3& position : scene.meshes[instance.mesh].positions)
      box.extend(glm::dvec3(instance.world_from_mesh * glm::dvec4(position, 1)));
  }
  for (const WarpOptions& options : {WarpOptions{WarpKind::best, false, 512, true, nullptr, {}},
                                     WarpOptions{WarpKind::best, false, 512, true, nullptr, casters},
                                     WarpOptions{WarpKind::psm, false, 512, true, nullptr, {}},
                                     WarpOptions{WarpKind::psm, true, 512, true, nullptr, {}},
                                     WarpOptions{WarpKind::light_space, false, 512, true, nullptr, {}}}) {
    Tally tally;
    const bool all = options.kind == WarpKind::best && options.casters.empty();
    for (int i = 0; i < (all ? 1000 : 200); ++i) {
      SCOPED_TRACE("pair " + std::to_string(i));
      const auto [camera, light] = pairs.next();
      const std::vector<SurfacePoint> points = trace(tracer, camera);
      const render::CameraView view = render::make_view(camera, camera.near, width, height);
      const Receivers receivers = see(view, points, light);
      std::vector<uint8_t> lit;
      if (!options.casters.empty()) lit = tracer.visible(points, glm::vec3(camera.eye), light, width);
      for (const LightFrame& frame : light_frames(light)) {
        const Warp warp = choose_warp(light, frame, CameraMap(view), receivers, bounds, options);
        check_view(warp, light, frame, view, receivers, points, lit, bounds, tally);
        if (HasFatalFailure()) return;
      }
    }
    EXPECT_GT(tally.receivers, options.casters.empty() ? 10'000 : 1'000);
    EXPECT_GT(tally.views, 3 * tally.fallbacks / 2);
    RecordProperty("views", tally.views);
    RecordProperty("fallbacks", tally.fallbacks);
    RecordProperty("mean_gain_percent", static_cast<int>(100 * std::exp(tally.log_gain / tally.views)));
  }
}

}  // namespace
}  // namespace shadewright::shadow
