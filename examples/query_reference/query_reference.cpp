// Asks the reference which points of a scene the sun reaches. Needs no GPU and no Vulkan: shadewright::core alone.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "shadewright/error.h"
#include "shadewright/raytrace/tracer.h"
#include "shadewright/scene/load.h"

namespace {

using namespace shadewright;

/// A flat square, 2 * half_size wide, level at `height`.
void add_square(Scene& scene, float half_size, double height) {
  Mesh mesh;
  mesh.positions = {
      {-half_size, 0, -half_size}, {-half_size, 0, half_size}, {half_size, 0, half_size}, {half_size, 0, -half_size}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  Instance instance;
  instance.mesh = static_cast<uint32_t>(scene.meshes.size());
  instance.world_from_mesh[3] = glm::dvec4(0, height, 0, 1);
  scene.meshes.push_back(mesh);
  scene.instances.push_back(instance);
}

/// Points of the ground along the x axis, and what the truth is there: true = lit.
struct Query {
  std::vector<SurfacePoint> points;
  std::vector<bool> expected;
};

int run() {
  // 1. A scene in code: a table's top 1 m above the ground, 2 m wide. Files and built-in scenes come from load_scene.
  Scene scene;
  add_square(scene, 10, 0);
  add_square(scene, 1, 1);

  // 2. The sun stands in the east (azimuth 0 = +X) at 45 degrees, so the shadow lies 1 m to the west: x in (-2, 0).
  const Light light = sun(0, 45);

  // 3. Points of surfaces, each with its geometric normal. All of them are traced at once, on every core.
  Query query;
  for (const float x : {-2.5f, -1.5f, -0.5f, 0.5f, 1.5f}) {
    query.points.push_back({{x, 0, 0}, {0, 1, 0}});
    query.expected.push_back(x < -2 || x > 0);
  }
  // The eye matters only for how exact the points are: those of a camera's depth buffer lose precision with distance.
  const glm::vec3 eye(0, 2, 0);
  const Tracer tracer(scene);
  const std::vector<uint8_t> lit = tracer.visible(query.points, eye, light);

  int wrong = 0;
  for (size_t i = 0; i < query.points.size(); ++i) {
    const glm::vec3 p = query.points[i].position;
    std::printf("(%4.1f, %.0f, %.0f) %s\n", p.x, p.y, p.z, lit[i] ? "lit" : "in shadow");
    wrong += (lit[i] != 0) != query.expected[i];
  }

  // 4. The same of a built-in scene, as a file would be read: what share of the picture does its light reach?
  const Scene chess = load_scene("builtin:chess").scene;
  const Tracer chess_tracer(chess);
  const PixelGrid grid{160, 90, chess.cameras.front()};
  const std::vector<PrimaryHit> hits = chess_tracer.primary(grid, near_distance(chess, grid.camera));
  std::vector<SurfacePoint> points(hits.size());
  for (uint32_t y = 0; y < grid.height; ++y)
    for (uint32_t x = 0; x < grid.width; ++x) {
      const PrimaryHit& hit = hits[y * grid.width + x];
      const glm::dvec3 position = grid.camera.eye + grid.ray(x + 0.5, y + 0.5) * static_cast<double>(hit.distance);
      points[y * grid.width + x] = {glm::vec3(position), hit.normal};  // no hit: a zero normal, which is skipped
    }
  size_t seen = 0, reached = 0;
  const std::vector<uint8_t> visible =
      chess_tracer.visible(points, glm::vec3(grid.camera.eye), chess.lights.front(), grid.width);
  for (size_t i = 0; i < points.size(); ++i) {
    seen += points[i].valid();
    reached += visible[i];
  }
  std::printf("%s: the light reaches %zu of %zu points seen\n", chess.name.c_str(), reached, seen);
  return wrong == 0 && reached > 0 && reached < seen ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main() {
  try {
    return run();
  } catch (const shadewright::Error& error) {
    std::fprintf(stderr, "query_reference: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
