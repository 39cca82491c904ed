#include "real_path.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <mutex>
#include <numeric>
#include <vector>

#include "quad.h"
#include "stabbing.h"

namespace shadewright::voxel {

namespace {

/// The quads of one height that the recursion starts from, each with its triangles: `items[starts[i]]` up to starts[i +
/// 1], in ascending order.
struct Bins {
  uint32_t log2_count = 0;  ///< per axis
  std::vector<uint64_t> starts;
  std::vector<uint32_t> items;
};

Bins bin_triangles(const SnappedCasters& casters, uint32_t log2_size, const TileRules& rules, MemoryBudget& budget) {
  Bins bins;
  bins.log2_count = std::min(6u, log2_size - kLog2Tile);
  const uint32_t count = 1u << bins.log2_count, height = log2_size - bins.log2_count;
  const size_t chunks = std::clamp<size_t>(casters.triangles.size() / 16384, 1, 64);
  std::vector<uint64_t> next(chunks * count * count, 0);  // [bin * chunks + chunk]
  const auto visit = [&](size_t chunk, auto&& use) {
    const size_t begin = casters.triangles.size() * chunk / chunks,
                 end = casters.triangles.size() * (chunk + 1) / chunks;
    for (size_t t = begin; t < end; ++t) {
      const SnappedTriangle& triangle = casters.triangles[t];
      const glm::ivec3* c = triangle.corners;
      const glm::ivec3 low = glm::min(c[0], glm::min(c[1], c[2])), high = glm::max(c[0], glm::max(c[1], c[2]));
      const auto bin = [&](int32_t sub_voxel, int32_t widen) {
        return std::clamp(((sub_voxel >> 8) + widen) >> height, 0, int32_t(count) - 1);
      };
      const int32_t widen = int32_t(rules.reach) + 1;
      for (int32_t y = bin(low.y, -widen); y <= bin(high.y, widen); ++y)
        for (int32_t x = bin(low.x, -widen); x <= bin(high.x, widen); ++x)
          if (touches(triangle, glm::ivec2(low), glm::ivec2(high),
                      CenterBox({height, x << height, y << height}, rules.reach, rules.size)))
            use((uint32_t(y) << bins.log2_count | uint32_t(x)) * chunks + chunk, uint32_t(t));
    }
  };
  tbb::parallel_for(size_t(0), chunks, [&](size_t c) { visit(c, [&](size_t slot, uint32_t) { ++next[slot]; }); });
  std::exclusive_scan(next.begin(), next.end(), next.begin(), uint64_t(0));
  for (uint32_t i = 0; i < count * count; ++i) bins.starts.push_back(next[i * chunks]);
  // The last slot's end is not in the scan: fill first, then it is known.
  uint64_t total = 0;
  visit(chunks - 1, [&](size_t slot, uint32_t) { total += slot == next.size() - 1; });
  bins.starts.push_back(next.back() + total);
  budget.add(bins.starts.back() * sizeof(uint32_t));
  bins.items.resize(bins.starts.back());
  tbb::parallel_for(size_t(0), chunks,
                    [&](size_t c) { visit(c, [&](size_t slot, uint32_t t) { bins.items[next[slot]++] = t; }); });
  return bins;
}

/// One thread's recursion, with memory that is kept between quads.
class QuadRecursion {
 public:
  QuadRecursion(DagBuilder& builder, const TileRules& rules, Resolving resolving)
      : builder_(builder),
        rules_(rules),
        resolving_(resolving),
        bounds_(rules),
        raster_(rules),
        tiles_(builder, resolving) {}

  Column run(const Quad& quad, const SnappedCasters& casters, std::span<const uint32_t> items) {
    local_.clear();
    for (const uint32_t item : items) local_.emplace_back(casters.triangles[item]);
    stack_.clear();
    for (const QuadTriangle& triangle : local_) stack_.push_back(&triangle);
    Column result;
    build(quad, 0, result);
    return result;
  }

  uint64_t quads = 0, tiles = 0;
  uint64_t stabbed() const { return tiles_.stabbed(); }

 private:
  /// `stack_` holds the quad's triangles from `begin` to its end.
  void build(const Quad& quad, size_t begin, Column& result) {
    ++quads;
    const size_t end = stack_.size();
    if (begin == end) return flat_column(builder_, quad.height, {rules_.depth, rules_.depth}, result);
    const std::span<const QuadTriangle* const> triangles = std::span(stack_).subspan(begin);
    if (const auto cut = bounds_.decide(quad, triangles))
      return flat_column(builder_, quad.height, choose_cut(resolving_, *cut), result);
    if (quad.height == kLog2Tile) {
      ++tiles;
      raster_.rasterize(triangles, bounds_.lows(), bounds_.highs(), quad.x, quad.y, ranges_);
      return tiles_.build(ranges_, result);
    }
    std::array<Column, 4> parts;
    for (uint32_t i = 0; i < 4; ++i) {
      const Quad part = quad.quarter(i);
      const CenterBox box(part, rules_.reach, rules_.size);
      for (size_t t = begin; t < end; ++t) {
        const QuadTriangle* triangle = stack_[t];
        if (touches(triangle->triangle, triangle->low, triangle->high, box)) stack_.push_back(triangle);
      }
      build(part, end, parts[i]);
      stack_.resize(end);
    }
    join_columns(builder_, quad.height, {&parts[0], &parts[1], &parts[2], &parts[3]}, result);
  }

  DagBuilder& builder_;
  TileRules rules_;
  Resolving resolving_;
  QuadBounds bounds_;
  TileRasterizer raster_;
  TileColumns tiles_;
  TileRanges ranges_;
  std::vector<QuadTriangle> local_;
  std::vector<const QuadTriangle*> stack_;
};

}  // namespace

Value build_from_triangles(DagBuilder& builder, const SnappedCasters& casters, const TileRules& rules,
                           Resolving resolving, MemoryBudget& budget, RealPathCounts& counts,
                           const Progress& progress) {
  const uint32_t log2_size = builder.log2_size();
  const Bins bins = bin_triangles(casters, log2_size, rules, budget);
  const uint32_t height = log2_size - bins.log2_count;
  uint32_t side = 1u << bins.log2_count;
  std::vector<Column> columns(size_t(side) * side);
  tbb::enumerable_thread_specific<QuadRecursion> recursions([&] { return QuadRecursion(builder, rules, resolving); });
  std::mutex reporting;
  size_t done = 0;
  progress("voxels", 0.0);
  tbb::parallel_for(size_t(0), columns.size(), [&](size_t i) {
    const Quad quad{height, int32_t(i & (side - 1)) << height, int32_t(i >> bins.log2_count) << height};
    columns[i] = recursions.local().run(
        quad, casters, std::span(bins.items).subspan(bins.starts[i], bins.starts[i + 1] - bins.starts[i]));
    const std::lock_guard lock(reporting);
    const size_t before = done++;
    if (done * 100 / columns.size() != before * 100 / columns.size())
      progress("voxels", double(done) / double(columns.size()));
  });
  for (const QuadRecursion& recursion : recursions) {
    counts.quads += recursion.quads;
    counts.tiles += recursion.tiles;
    counts.stabbed += recursion.stabbed();
  }
  for (uint32_t up = height + 1; up <= log2_size; ++up) {
    side /= 2;
    std::vector<Column> joined(size_t(side) * side);
    tbb::parallel_for(size_t(0), joined.size(), [&](size_t i) {
      const size_t first = (i / side) * 2 * (2 * size_t(side)) + (i % side) * 2;
      join_columns(builder, up,
                   {&columns[first], &columns[first + 1], &columns[first + 2 * size_t(side)],
                    &columns[first + 2 * size_t(side) + 1]},
                   joined[i]);
    });
    columns = std::move(joined);
  }
  budget.remove(bins.items.size() * sizeof(uint32_t));
  return columns.front().front().value;
}

}  // namespace shadewright::voxel
