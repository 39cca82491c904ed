// Which instances of a scene are drawn as points, and as how many.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "scene/points/pieces.h"
#include "shadewright/scene/points.h"

namespace shadewright {
namespace {

/// The most that `to_from` lengthens anything: exact for rotations, mirrors and scalings, else a little more.
double largest_scale(const glm::dmat4& to_from) {
  const glm::dmat3 m(to_from), squared = glm::transpose(m) * m;
  double largest = 0;
  for (int column = 0; column < 3; ++column)
    largest =
        std::max(largest, std::abs(squared[column].x) + std::abs(squared[column].y) + std::abs(squared[column].z));
  return std::sqrt(largest);
}

double distance(const Box& box, const glm::dvec3& p) {
  return glm::distance(p, glm::clamp(p, box.min, box.max));
}

/// How far apart samples of each instance may be, in its mesh's space.
std::vector<double> allowed_radii(const Scene& scene, std::span<const PointView> views, double spacing) {
  std::vector<Box> boxes;
  for (const Mesh& mesh : scene.meshes) boxes.push_back(bounds(mesh));
  std::vector<double> allowed(scene.instances.size(), std::numeric_limits<double>::infinity());
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    for (const PointView& view : views) {
      const glm::dmat4 world_from_mesh = transform_at(scene, instance, view.time);
      const double away = distance(transform(world_from_mesh, boxes[instance.mesh]), view.eye);
      allowed[i] = std::min(allowed[i], spacing * view.pixel * away / largest_scale(world_from_mesh));
    }
  }
  return allowed;
}

size_t most_samples(const Mesh& mesh, const PointOptions& options) {
  const double most = options.most_splats * static_cast<double>(mesh.triangles.size());
  return most < 1 ? 0 : std::bit_floor(static_cast<size_t>(most));
}

/// False when no sampling of at most `most` points can be as dense as `allowed` asks for. A sample serves a disc of the
/// allowed radius; crumpled surfaces, of which a ball holds more, are given a factor.
bool may_be_points(const Mesh& mesh, size_t most, double allowed) {
  constexpr double crumpled = 16.0;
  return most > 0 && points::surface_area(mesh) < crumpled * 3.2 * allowed * allowed * static_cast<double>(most);
}

/// The smallest power of two of samples that are nowhere further apart than `allowed`; 0 if even all are too few.
size_t samples_for(const PointSampling& sampling, double allowed) {
  for (size_t count = 1; count <= sampling.radii.size(); count *= 2)
    if (double{sampling.radii[count - 1]} <= allowed) return count;
  return 0;
}

/// Splats of `mesh` by how many samples they show: all that instances with these `allowed` radii are drawn as, and
/// which of them each instance takes (0 = the mesh itself).
struct Levels {
  std::map<size_t, Mesh> splats;
  std::vector<size_t> count_of_instance;
};

Levels make_levels(const Mesh& mesh, std::span<const double> allowed, const PointOptions& options) {
  Levels levels;
  levels.count_of_instance.assign(allowed.size(), 0);
  const size_t most = most_samples(mesh, options);
  if (allowed.empty() || !may_be_points(mesh, most, *std::max_element(allowed.begin(), allowed.end()))) return levels;
  const PointSampling sampling = sample_points(mesh, most);
  std::vector<size_t> counts;
  for (size_t i = 0; i < allowed.size(); ++i) counts.push_back(samples_for(sampling, allowed[i]));
  levels.count_of_instance = counts;
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  std::erase(counts, size_t{0});
  std::vector<Mesh> splats = splat_meshes(mesh, sampling, counts);
  const double most_triangles = options.most_splats * static_cast<double>(mesh.triangles.size());
  for (size_t i = 0; i < counts.size(); ++i)
    if (static_cast<double>(splats[i].triangles.size()) <= most_triangles && !splats[i].triangles.empty())
      levels.splats.emplace(counts[i], std::move(splats[i]));
  for (size_t& count : levels.count_of_instance)
    if (!levels.splats.contains(count)) count = 0;
  return levels;
}

std::vector<Levels> make_levels(const Scene& scene, std::span<const std::vector<uint32_t>> instances_of_mesh,
                                std::span<const double> allowed, const PointOptions& options,
                                const Progress& progress) {
  std::vector<Levels> levels(scene.meshes.size());
  std::mutex telling;
  size_t done = 0;
  tbb::parallel_for(size_t{0}, scene.meshes.size(), [&](size_t m) {
    std::vector<double> radii;
    for (const uint32_t instance : instances_of_mesh[m]) radii.push_back(allowed[instance]);
    levels[m] = make_levels(scene.meshes[m], radii, options);
    const std::lock_guard lock(telling);
    progress("points", static_cast<double>(++done) / static_cast<double>(scene.meshes.size()));
  });
  return levels;
}

}  // namespace

PointView point_view(const Camera& camera, uint32_t image_height, double time) {
  return {camera.eye, 2.0 * std::tan(0.5 * camera.fov_y) / image_height, time};
}

Scene with_points(const Scene& scene, std::span<const PointView> views, const PointOptions& options,
                  PointSummary* summary, const Progress& progress) {
  std::vector<std::vector<uint32_t>> instances_of_mesh(scene.meshes.size());
  for (uint32_t i = 0; i < scene.instances.size(); ++i) instances_of_mesh[scene.instances[i].mesh].push_back(i);
  std::vector<Levels> levels =
      make_levels(scene, instances_of_mesh, allowed_radii(scene, views, options.spacing), options, progress);

  Scene result;
  result.name = scene.name;
  result.origin = scene.origin;
  result.instances = scene.instances;
  result.motions = scene.motions;
  result.cameras = scene.cameras;
  result.lights = scene.lights;
  result.paths = scene.paths;
  PointSummary counted;
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    std::map<size_t, uint32_t> mesh_of_count;
    for (size_t k = 0; k < instances_of_mesh[m].size(); ++k) {
      const size_t count = levels[m].count_of_instance[k];
      const auto [entry, is_new] = mesh_of_count.try_emplace(count, static_cast<uint32_t>(result.meshes.size()));
      if (is_new) result.meshes.push_back(count == 0 ? scene.meshes[m] : std::move(levels[m].splats.at(count)));
      result.instances[instances_of_mesh[m][k]].mesh = entry->second;
      if (count == 0) continue;
      ++counted.instances;
      counted.splats += count;
      counted.splat_triangles += result.meshes[entry->second].triangles.size();
      counted.replaced_triangles += scene.meshes[m].triangles.size();
    }
  }
  if (summary != nullptr) *summary = counted;
  return result;
}

std::string describe(const PointSummary& summary) {
  return fmt::format("{} instances are drawn as {} points ({} triangles instead of {}).", summary.instances,
                     summary.splats, summary.splat_triangles, summary.replaced_triangles);
}

}  // namespace shadewright
