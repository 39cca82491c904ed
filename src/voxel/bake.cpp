#include "shadewright/voxel/bake.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

#include "casters.h"
#include "layout.h"
#include "light_fit.h"
#include "real_path.h"
#include "reference_path.h"
#include "shadewright/error.h"
#include "snapped.h"
#include "topology.h"

namespace shadewright::voxel {

namespace {

void check_power(uint32_t value, uint32_t max, const char* what) {
  if (!std::has_single_bit(value) || value < 64 || value > max)
    throw InputError(fmt::format("{} {}", what, value), fmt::format("must be a power of two from 64 to {}", max));
}

void check(const BakeOptions& options) {
  check_power(options.resolution, 1u << 20, "resolution");
  if (options.depth_voxels) check_power(*options.depth_voxels, options.resolution, "depth");
  if (options.max_filter % 2 == 0 || options.max_filter > 17)
    throw InputError(fmt::format("max-filter {}", options.max_filter), "must be odd, from 1 to 17");
  if (!(options.memory_gigabytes > 0))
    throw InputError(fmt::format("memory {}", options.memory_gigabytes), "must be a positive number of gigabytes");
}

/// Times what runs between its calls.
class Stages {
 public:
  explicit Stages(std::vector<StageSeconds>& stages) : stages_(stages) {}
  void finish(const char* name) {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - begin_).count();
    begin_ = now;
    for (StageSeconds& stage : stages_)
      if (stage.name == name) {
        stage.seconds += seconds;
        return;
      }
    stages_.push_back({name, seconds});
  }

 private:
  std::vector<StageSeconds>& stages_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

Dag finish_dag(const DagBuilder& builder, Value root) {
  return lay_out(builder, root == kAllUndefined ? kAllVisible : root, grid_for(builder.log2_size()));
}

VoxelShadow own(const ShadowProperties& properties, std::vector<Dag>&& dags) {
  const auto owner = std::make_shared<const std::vector<Dag>>(std::move(dags));
  std::vector<DagView> views;
  std::vector<std::vector<uint64_t>> starts;
  for (const Dag& dag : *owner) {
    views.push_back(dag.view());
    starts.push_back(dag.level_starts);
  }
  return VoxelShadow(properties, std::move(views), std::move(starts), owner);
}

BakeResult run(const Scene& scene, const Light& light, const BakeOptions& options, const Progress& progress) {
  BakeStatistics statistics;
  Stages stages(statistics.stages);
  const auto begin = std::chrono::steady_clock::now();
  MemoryBudget budget(uint64_t(std::min(options.memory_gigabytes, 1e9) * 1e9));
  progress("triangles", 0.0);
  const Casters casters = gather_casters(scene);
  if (casters.triangles.empty())
    throw InputError("bake", "the scene has no static triangles", "instances with a motion are not baked");
  budget.add(casters.positions.size() * (sizeof(glm::dvec3) + 16) +
             casters.triangles.size() * (sizeof(glm::uvec3) + 24));
  stages.finish("weld");
  progress("triangles", 0.3);
  const Topology topology = find_topology(casters, scene, options.closed);
  stages.finish("topology");
  progress("triangles", 0.6);
  LightGrid grid = fit_light(casters, light, options);
  stages.finish("fit");

  statistics.triangles = casters.triangles.size();
  statistics.moving_instances = casters.moving_instances;
  statistics.components = topology.components;
  ShadowProperties properties{
      grid, options.max_filter, filter_margin(grid, options.max_filter), options.static_receivers,
      topology.components.open + topology.components.inwards + topology.components.inhabited == 0};
  std::vector<Dag> dags;
  RealPathCounts counts;
  for (;; grid = grid.halved()) {
    const SnappedCasters snapped = snap(casters, topology, grid);
    budget.add(snapped.triangles.size() * sizeof(SnappedTriangle));
    stages.finish("snap");
    if (dags.empty()) {
      statistics.clipped_triangles = snapped.clipped;
      statistics.silhouette_triangles = snapped.silhouette;
      progress("triangles", 1.0);
    }
    DagBuilder builder(grid.log2_size, budget);
    const TileRules rules{int32_t(grid.size()), options.max_filter / 2, filter_margin(grid, options.max_filter),
                          int32_t(grid.depth()), options.static_receivers};
    const Value root = build_from_triangles(builder, snapped, rules, options.resolving, budget, counts, progress);
    stages.finish("voxels");
    progress("layout", 0.0);
    dags.push_back(finish_dag(builder, root));
    progress("layout", 1.0);
    stages.finish("layout");
    budget.remove(snapped.triangles.size() * sizeof(SnappedTriangle));
    if (!options.pyramid || grid.log2_size == 6 || grid.log2_depth == 6) break;
  }
  statistics.quads = counts.quads;
  statistics.tiles = counts.tiles;
  statistics.stabbed_leaves = counts.stabbed;
  statistics.peak_bytes = budget.peak();
  statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  BakeResult result{own(properties, std::move(dags)), std::move(statistics)};
  result.statistics.levels = count_levels(result.shadow);
  return result;
}

}  // namespace

BakeResult bake(const Scene& scene, const Light& light, const BakeOptions& options, const Progress& progress) {
  check(options);
  // oneTBB warns of more threads than it may have, and takes no more.
  const auto most = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  tbb::task_arena arena(options.threads == 0 ? tbb::info::default_concurrency()
                                             : int(std::min<size_t>(options.threads, most)));
  return arena.execute([&] { return run(scene, light, options, progress); });
}

VoxelShadow bake_depth_map(std::span<const float> depth, std::span<const float> exit, const LightGrid& grid,
                           uint32_t max_filter, const Progress& progress) {
  BakeOptions options;
  options.resolution = grid.size();
  options.max_filter = max_filter;
  check(options);
  const size_t texels = size_t(grid.size()) * grid.size();
  if (depth.size() != texels || (!exit.empty() && exit.size() != texels) || grid.log2_depth != grid.log2_size)
    throw InputError("depth map", fmt::format("needs {0} x {0} texels, and as many voxels in depth", grid.size()));
  const double size = grid.size();
  // Voxels whose centres lie before a depth: z + 0.5 <= N depth.
  const auto height = [&](float value) {
    return int32_t(std::clamp(std::floor(double(value) * size + 0.5), 0.0, size));
  };
  std::vector<int32_t> first(texels), limit(texels);
  for (size_t i = 0; i < texels; ++i) {
    if (std::isnan(depth[i]) || (!exit.empty() && std::isnan(exit[i])))
      throw InputError("depth map", "has a depth that is not a number");
    first[i] = height(depth[i]);
    limit[i] = std::max(first[i], exit.empty() ? first[i] : height(exit[i]));
  }
  MemoryBudget budget(~uint64_t(0) >> 1);
  DagBuilder builder(grid.log2_size, budget);
  const Value root = build_from_maps(builder, first, limit, progress);
  std::vector<Dag> dags;
  dags.push_back(finish_dag(builder, root));
  return own({grid, max_filter, 0, false, false}, std::move(dags));
}

}  // namespace shadewright::voxel
