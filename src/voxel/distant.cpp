// Look-ups for pixels that cover many texels (CPVS, section 5: multi-resolution and voxel occupancy antialiasing).
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "batch.h"
#include "lookup.h"
#include "shadewright/error.h"
#include "shadewright/voxel/shadow.h"

namespace shadewright::voxel {

namespace {

/// The share of visible voxels in the node of side 2^height (3 to the grid's) around a voxel inside the volume.
double node_visibility(const DagView& dag, const glm::uvec3& voxel, uint32_t height) {
  uint32_t above = dag.log2_size - dag.log2_grid;
  const glm::uvec3 cell = voxel >> above;
  uint32_t at = dag.grid[(size_t(cell.z) << 2 * dag.log2_grid) + (cell.y << dag.log2_grid) + cell.x];
  if (at <= kVisible) return at;
  for (; above > height; --above) {
    const glm::uvec3 bits = (voxel >> (above - 1)) & 1u;
    const uint32_t header = dag.nodes[at], child = bits.x | bits.y << 1 | bits.z << 2, code = child_code(header, child);
    if (code < kOwnPointer) return code;
    at = dag.nodes[at + 1 + pointer_index(header, child, true)];
  }
  return 1.0 - double(dag.nodes[at] >> 16) / 65535.0;
}

/// Occupancy before a receiver, between the heights below and above `log2_side`. Half a node's offset, as the paper has
/// it, leaves the receiver's own surface in some nodes: its pattern shows on open ground.
float occupancy_visibility(const DagView& dag, const LightGrid& light, const SurfacePoint& point, double log2_side) {
  const double side = std::clamp(log2_side, double(kSlabHeight), double(dag.log2_size - dag.log2_grid));
  const glm::dvec3 world(point.position), at = light.voxel(world);
  const double size = light.size();
  if (!(at.x >= 0 && at.x < size && at.y >= 0 && at.y < size && at.z >= 0 && at.z < 4e6)) return 1.0f;
  const glm::dvec2 slope = light.plane_slope(world, glm::dvec3(point.normal));
  const auto visibility = [&](uint32_t height) {
    const glm::ivec3 node = LightGrid::clear_node(at, slope, height);
    if (node.z < 0) return 1.0;
    const glm::uvec3 voxel = glm::uvec3(node) << height;
    return node_visibility(dag, {voxel.x, voxel.y, std::min(voxel.z, light.depth() - 1)}, height);
  };
  const double low = std::floor(side), share = side - low;
  const double fine = visibility(uint32_t(low));
  return float(share == 0 ? fine : std::lerp(fine, visibility(uint32_t(low) + 1), share));
}

}  // namespace

void VoxelShadow::distant_visibility(std::span<const SurfacePoint> points, std::span<const float> footprints,
                                     uint32_t taps, Distant how, std::span<float> result) const {
  check_taps(taps);
  if (points.size() != result.size() || points.size() != footprints.size())
    throw InputError("distant visibility", fmt::format("{} points, {} footprints, room for {} results", points.size(),
                                                       footprints.size(), result.size()));
  if (how == Distant::mraa && dags_.size() < 2)
    throw InputError("distant visibility", "the shadow has no pyramid", "bake with --mraa, or use voaa");

  std::vector<LightGrid> lights{light()};
  while (lights.size() < dags_.size()) lights.push_back(lights.back().halved());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, points.size(), 1024), [&](const auto& range) {
    // Points of one level are looked up together.
    std::vector<std::vector<size_t>> levels(how == Distant::mraa ? dags_.size() : 1);
    for (size_t i = range.begin(); i < range.end(); ++i) {
      const glm::dvec3 extent = light().voxel_extent(glm::dvec3(points[i].position));
      const double texels = double(footprints[i]) / std::sqrt(std::max(extent.x * extent.y, 1e-300));
      const bool far = texels > taps;  // false for what is not a number
      if (how == Distant::voaa && far) {
        // Nodes stand on a grid, not around the receiver: half as wide as the pixel, they reach about as far.
        result[i] = occupancy_visibility(dags_[0], light(), points[i], std::log2(0.5 * texels));
        continue;
      }
      const double level = far ? std::floor(std::log2(texels / taps)) : 0.0;
      levels[size_t(std::min(level, double(levels.size() - 1)))].push_back(i);
    }
    std::vector<SurfacePoint> some;
    std::vector<float> answers;
    for (size_t level = 0; level < levels.size(); ++level) {
      some.clear();
      for (const size_t i : levels[level]) {
        some.push_back(points[i]);
        if (level == 0) continue;
        const LightGrid& coarse = lights[level];
        some.back().position = glm::vec3(
            coarse.distant_receiver(glm::dvec3(points[i].position), glm::dvec3(points[i].normal), 0.5 * taps));
        some.back().normal = glm::vec3(0);  // half a voxel of depth is left to move
      }
      answers.resize(some.size());
      look_up(dags_[level], lights[level], some, taps, answers);
      for (size_t i = 0; i < some.size(); ++i) result[levels[level][i]] = answers[i];
    }
  });
}

}  // namespace shadewright::voxel
