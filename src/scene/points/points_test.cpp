// Samplings: progressive, evenly spread, the same each time; splats: without holes on surfaces, true to the area of
// leaves; scenes: near things stay triangles.
#include "shadewright/scene/points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "scene/builtin/mesh_check.h"
#include "scene/builtin/random.h"
#include "scene/builtin/shapes/box.h"
#include "scene/builtin/shapes/lathe.h"
#include "scene/builtin/tree.h"
#include "shadewright/scene/builtin.h"

namespace shadewright {
namespace {

constexpr uint64_t seed = 20020721;

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const glm::uvec3& t : mesh.triangles)
    area += 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - glm::dvec3(mesh.positions[t.x]),
                                         glm::dvec3(mesh.positions[t.z]) - glm::dvec3(mesh.positions[t.x])));
  return area;
}

/// Points spread over the surface by area.
std::vector<glm::dvec3> random_points(const Mesh& mesh, size_t count) {
  std::mt19937_64 random(seed);
  std::vector<double> areas;
  for (const glm::uvec3& t : mesh.triangles) {
    Mesh one;
    one.positions = mesh.positions;
    one.triangles = {t};
    areas.push_back(area_of(one));
  }
  std::discrete_distribution<size_t> pick(areas.begin(), areas.end());
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<glm::dvec3> result;
  for (size_t i = 0; i < count; ++i) {
    const glm::uvec3& t = mesh.triangles[pick(random)];
    double u = unit(random), v = unit(random);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    result.push_back(a + u * (b - a) + v * (c - a));
  }
  return result;
}

/// The distance of `p` from the nearest of the first `count` samples.
double nearest(const PointSampling& sampling, size_t count, const glm::dvec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < count; ++i)
    least = std::min(least, glm::distance(p, glm::dvec3(sampling.samples[i].position)));
  return least;
}

Mesh flat_square(double size) {
  Mesh mesh;
  const auto s = static_cast<float>(size);
  mesh.positions = {{0, 0, 0}, {0, 0, s}, {s, 0, s}, {s, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// Surfaces of one piece: round, with edges, and with parts both thick and thin.
std::vector<Mesh> wide_surfaces() {
  Scene scene;
  builtin::Random random(3);
  return {builtin::sphere(1.0, 32, 20), flat_square(2), builtin::lump({1, 2, 3}, {2, 0.7, 1}, 24, 16, 0.2, random),
          builtin::lathe(builtin::Profile{{0.6, 0}, {0.3, 0.5}, {0.35, 1.5}, {0.7, 2}}, 24)};
}

Mesh crown() {
  Scene scene;
  builtin::Random random(5);
  builtin::TreeShape shape;
  shape.crown = builtin::Crown::sheets;
  shape.leaf_count = 800;
  return scene.meshes[builtin::broadleaf_tree(scene, shape, random).parts.back().mesh];
}

TEST(PointSampling, IsTheSameEachTimeAndItsPrefixesAreSamplings) {
  for (const Mesh& mesh : wide_surfaces()) {
    const PointSampling sampling = sample_points(mesh, 512), again = sample_points(mesh, 512);
    ASSERT_EQ(sampling.samples.size(), 512u);
    ASSERT_EQ(sampling.radii, again.radii);
    for (size_t i = 0; i < 512; ++i) {
      EXPECT_EQ(sampling.samples[i].position, again.samples[i].position);
      EXPECT_EQ(sampling.samples[i].normal, again.samples[i].normal);
      EXPECT_NEAR(glm::length(sampling.samples[i].normal), 1, 1e-5);
    }
    EXPECT_TRUE(std::is_sorted(sampling.radii.rbegin(), sampling.radii.rend()));
  }
}

TEST(PointSampling, EveryPrefixCoversTheSurfaceWithinItsRadius) {
  std::vector<Mesh> meshes = wide_surfaces();
  meshes.push_back(crown());
  for (const Mesh& mesh : meshes) {
    const PointSampling sampling = sample_points(mesh, 600);
    for (const size_t count : {1u, 2u, 7u, 64u, 300u, 600u})
      for (const glm::dvec3& p : random_points(mesh, 2000))
        EXPECT_LE(nearest(sampling, count, p), double{sampling.radii[count - 1]} * (1 + 1e-5))
            << count << ", seed " << seed;
  }
}

TEST(PointSampling, IsSpreadLikeBlueNoise) {
  for (const Mesh& mesh : wide_surfaces()) {
    const PointSampling sampling = sample_points(mesh, 1024);
    for (const size_t count : {32u, 128u, 512u, 1024u}) {
      std::vector<double> distances;
      for (size_t i = 0; i < count; ++i) {
        double least = std::numeric_limits<double>::infinity();
        for (size_t j = 0; j < count; ++j)
          if (i != j)
            least = std::min<double>(least, glm::distance(sampling.samples[i].position, sampling.samples[j].position));
        distances.push_back(least);
      }
      std::sort(distances.begin(), distances.end());
      // The closest pair of hexagonally packed points on a plane is sqrt(2 area / (sqrt(3) n)) apart, of random points
      // about 0.5 sqrt(area) / n.
      const double packed = std::sqrt(2 * area_of(mesh) / (std::sqrt(3.0) * static_cast<double>(count)));
      EXPECT_GT(distances.front(), 0.3 * packed) << count;
      EXPECT_GT(distances[count / 20], 0.45 * packed) << count;
      EXPECT_GT(distances[count / 2], 0.6 * packed) << count;
      EXPECT_LT(double{sampling.radii[count - 1]}, 1.7 * packed) << count;
    }
  }
}

TEST(Splats, CoverWideSurfacesWithoutHoles) {
  for (const Mesh& mesh : wide_surfaces()) {
    const PointSampling sampling = sample_points(mesh, 512);
    const std::vector<size_t> counts{32, 100, 512};
    const std::vector<Mesh> levels = splat_meshes(mesh, sampling, counts);
    for (size_t level = 0; level < counts.size(); ++level) {
      const std::vector<glm::vec3>& corners = levels[level].positions;
      ASSERT_EQ(corners.size(), 4 * counts[level]);
      const double radius = double{sampling.radii[counts[level] - 1]};
      size_t holes = 0;
      for (const glm::dvec3& p : random_points(mesh, 5000)) {
        bool covered = false;
        for (size_t s = 0; s < counts[level] && !covered; ++s) {
          const glm::dvec3 from = p - glm::dvec3(corners[4 * s]);
          const glm::dvec3 u = glm::dvec3(corners[4 * s + 1]) - glm::dvec3(corners[4 * s]),
                           v = glm::dvec3(corners[4 * s + 3]) - glm::dvec3(corners[4 * s]);
          const double a = glm::dot(from, u) / glm::dot(u, u), b = glm::dot(from, v) / glm::dot(v, v);
          const double height = glm::dot(from, glm::normalize(glm::cross(u, v)));
          covered = std::min(a, b) >= -1e-5 && std::max(a, b) <= 1 + 1e-5 && std::abs(height) <= radius;
        }
        holes += !covered;
      }
      EXPECT_EQ(holes, 0u) << mesh.name << " in " << counts[level] << ", seed " << seed;
      EXPECT_EQ(builtin::count_unsound_triangles(levels[level]), 0u);
    }
  }
}

TEST(Splats, FaceAsTheSurfaceDoes) {
  const Mesh mesh = builtin::sphere(1.0, 32, 20);
  const Mesh splats = splat_mesh(mesh, sample_points(mesh, 200), 200);
  for (const glm::uvec3& t : splats.triangles) {
    const glm::vec3 a = splats.positions[t.x], b = splats.positions[t.y], c = splats.positions[t.z];
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), a + b + c), 0);
  }
}

TEST(Splats, KeepTheAreaOfLeaves) {
  const Mesh leaves = crown();
  const PointSampling sampling = sample_points(leaves, 512);
  const std::vector<size_t> counts{64, 128, 256, 512};
  const std::vector<Mesh> levels = splat_meshes(leaves, sampling, counts);
  for (size_t i = 0; i < counts.size(); ++i) {
    EXPECT_GT(area_of(levels[i]), 0.8 * area_of(leaves)) << counts[i];
    EXPECT_LT(area_of(levels[i]), 1.05 * area_of(leaves)) << counts[i];
    EXPECT_LE(levels[i].triangles.size(), 2 * counts[i]);
  }
}

TEST(Splats, TheSameOneByOneAsTogether) {
  const Mesh mesh = crown();
  const PointSampling sampling = sample_points(mesh, 256);
  const std::vector<size_t> counts{0, 1, 16, 256, 1000};
  const std::vector<Mesh> levels = splat_meshes(mesh, sampling, counts);
  for (size_t i = 0; i < counts.size(); ++i)
    EXPECT_EQ(levels[i].positions, splat_mesh(mesh, sampling, counts[i]).positions) << counts[i];
  EXPECT_TRUE(levels[0].triangles.empty());
  EXPECT_EQ(levels[3].positions, levels[4].positions);
}

TEST(PointSampling, OfNothingIsEmpty) {
  EXPECT_TRUE(sample_points(Mesh{}, 10).samples.empty());
  EXPECT_TRUE(splat_mesh(Mesh{}, PointSampling{}, 10).triangles.empty());
}

TEST(WithPoints, NearStaysTrianglesAndFarGetsCoarser) {
  Scene scene;
  scene.meshes = {builtin::sphere(1.0, 64, 40)};
  for (const double away : {5.0, 300.0, 1200.0, 1210.0}) {
    scene.instances.emplace_back();
    scene.instances.back().world_from_mesh[3] = glm::dvec4(0, 0, -away, 1);
  }
  Camera camera;
  const PointView view = point_view(camera, 720);
  PointSummary summary;
  const Scene drawn = with_points(scene, std::span(&view, 1), {}, &summary);
  ASSERT_EQ(drawn.instances.size(), 4u);
  const auto shown = [&](size_t i) -> const Mesh& { return drawn.meshes[drawn.instances[i].mesh]; };
  EXPECT_EQ(shown(0).positions, scene.meshes[0].positions);
  EXPECT_LT(shown(1).triangles.size(), shown(0).triangles.size());
  EXPECT_LT(shown(2).triangles.size(), shown(1).triangles.size());
  EXPECT_EQ(drawn.instances[2].mesh, drawn.instances[3].mesh);
  EXPECT_EQ(summary.instances, 3u);
  EXPECT_EQ(summary.replaced_triangles, 3 * scene.meshes[0].triangles.size());
  EXPECT_EQ(summary.splat_triangles + shown(0).triangles.size(), triangle_count(drawn));

  // Larger, or seen from nearer at some time: the nearest view decides.
  const PointView close{{0, 0, -1200}, view.pixel, 0};
  const std::vector<PointView> views{view, close};
  EXPECT_EQ(with_points(scene, views).meshes[0].positions, scene.meshes[0].positions);
  scene.instances[2].world_from_mesh = scene.instances[2].world_from_mesh * glm::dmat4(glm::dmat3(100.0));
  const Scene large = with_points(scene, std::span(&view, 1));
  EXPECT_EQ(large.meshes[large.instances[2].mesh].positions, scene.meshes[0].positions);
}

}  // namespace
}  // namespace shadewright
