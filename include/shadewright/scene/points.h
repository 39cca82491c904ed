// Point rendering: far meshes drawn as splats whose density follows their distance (Stamminger and Drettakis 2002,
// section 5).
//
// What differs from the paper: a mesh drawn as points is another mesh, of one small polygon ("splat") a sample, and
// which instances are drawn so is chosen once, from the camera. So the camera pass, the maps and the ray-traced truth
// show the same surface whatever the technique, an instance is never half of each, and nothing that draws needs to know
// of points. Round splats would need a fragment that discards, which costs the early depth test, and a second kind of
// geometry in every technique and in the truth.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "shadewright/progress.h"
#include "shadewright/scene/scene.h"

namespace shadewright {

/// A point of a mesh's surface, in the mesh's space.
struct SurfaceSample {
  glm::vec3 position{0.0f};
  glm::vec3 normal{0.0f};  ///< geometric, unit
};

/// Samples of a mesh in progressive order: the first n of them, for any n, are themselves spread evenly (as blue noise
/// is), each new one being where the surface is farthest from those before it.
struct PointSampling {
  std::vector<SurfaceSample> samples;
  /// radii[n - 1]: no point of the surface is farther than this from all of the first n samples. Descending.
  std::vector<float> radii;
  double piece_size = 0;  ///< how long an edge of the pieces of surface is that were looked at, at most
};

/// Samples `mesh`, at most `most_samples` (fewer where more would fall onto each other). Deterministic. `most_samples`
/// also says how finely the surface is looked at. Farthest-point strategy, Eldar et al. 1997, with a distance that
/// grows up to twofold between surfaces of different orientation, so that thin parts get samples on more than one side.
PointSampling sample_points(const Mesh& mesh, size_t most_samples);

/// Splats for the first `count` samples: each stands for the part of the surface that is nearest to its sample.
/// Connected surfaces at least as wide, on average, as the samples' radius are covered without holes: the splat is a
/// rectangle that holds all of their part, seen along the sample's normal. Narrower ones, the leaves of a tree far
/// away, are kept by area instead (half of it where they are closed and show one of two sides): the splat is a triangle
/// of the sample's orientation and the leaves' spread and total area, so that foliage lets through as much light as it
/// did (after Cook et al. 2007, "Stochastic simplification of aggregate detail").
Mesh splat_mesh(const Mesh& mesh, const PointSampling& sampling, size_t count);
/// As splat_mesh, for several ascending counts at little more than the price of the last.
std::vector<Mesh> splat_meshes(const Mesh& mesh, const PointSampling& sampling, std::span<const size_t> counts);

/// From where, and when, a scene is seen.
struct PointView {
  glm::dvec3 eye{0.0};
  double pixel = 0;  ///< a pixel's size over its distance, that is its angle
  double time = 0;   ///< seconds
};
PointView point_view(const Camera& camera, uint32_t image_height, double time = 0);

struct PointOptions {
  double spacing = 2.0;  ///< largest distance from the surface to the nearest sample, in pixels; most is half as far
  /// Splats are used where they are at most this share of a mesh's triangles; above 1 draws as points what would be
  /// faster as triangles.
  double most_splats = 0.5;
};

/// What became of a scene.
struct PointSummary {
  size_t instances = 0;             ///< drawn as points
  uint64_t splats = 0;              ///< of them, every instance counted
  uint64_t splat_triangles = 0;     ///< what the splats are drawn as
  uint64_t replaced_triangles = 0;  ///< what those instances had
};

/// `scene` with every instance that is far enough from all `views` drawn as points: where samples no further apart than
/// `spacing` pixels, at the nearest point of the instance's box, are fewer than the mesh's triangles. Numbers of
/// samples are powers of two, so that instances share them. Instances keep their order; meshes that nobody shows are
/// left out.
Scene with_points(const Scene& scene, std::span<const PointView> views, const PointOptions& options = {},
                  PointSummary* summary = nullptr, const Progress& progress = no_progress);

/// One sentence for a report.
std::string describe(const PointSummary& summary);

}  // namespace shadewright
