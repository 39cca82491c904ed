#include "shadewright/voxel/check.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <random>

#include "casters.h"
#include "direct.h"
#include "snapped.h"
#include "topology.h"

namespace shadewright::voxel {

namespace {
constexpr int32_t kSide = 32;
constexpr uint64_t kSamplesPerSquare = 1024;
}  // namespace

CheckResult check_shadow(const Scene& scene, const VoxelShadow& shadow, const BakeOptions& options, uint64_t samples,
                         uint32_t seed, const Progress& progress) {
  const LightGrid& grid = shadow.light();
  const Casters casters = gather_casters(scene);
  const SnappedCasters snapped = snap(casters, find_topology(casters, scene, options.closed), grid);
  const DirectDepths direct(snapped, grid,
                            {options.static_receivers, options.max_filter, filter_margin(grid, options.max_filter)});
  const uint64_t squares = (samples + kSamplesPerSquare - 1) / kSamplesPerSquare;
  std::atomic<uint64_t> asked{0}, undefined{0}, wrong{0};
  std::mutex reporting;
  uint64_t done = 0;
  progress("check", 0.0);
  tbb::parallel_for(uint64_t(0), squares, [&](uint64_t square) {
    std::mt19937_64 random(uint64_t(seed) << 32 | square);
    const int32_t last = int32_t(grid.size()) - kSide;
    glm::ivec2 corner(int32_t(random() % uint64_t(last + 1)), int32_t(random() % uint64_t(last + 1)));
    if (square % 2 == 0 && !snapped.triangles.empty()) {
      const SnappedTriangle& triangle = snapped.triangles[random() % snapped.triangles.size()];
      corner = glm::ivec2(triangle.corners[random() % 3]) / kSubVoxels - kSide / 2;
      corner = glm::clamp(corner, glm::ivec2(0), glm::ivec2(last));
    }
    const std::vector<TexelRange> ranges = direct.ranges(corner.x, corner.y, kSide, kSide);
    uint64_t square_wrong = 0, square_undefined = 0;
    for (uint64_t i = 0; i < kSamplesPerSquare; ++i) {
      const TexelRange& range = ranges[i];
      int32_t z = int32_t(random() % grid.depth());
      if (i % 2 == 0) z = (random() % 2 ? range.first : range.limit) - int32_t(random() % 3) + 1;
      z = std::clamp(z, 0, int32_t(grid.depth()) - 1);
      if (z >= range.first && z < range.limit)
        ++square_undefined;
      else
        square_wrong +=
            shadow.visible({corner.x + int32_t(i) % kSide, corner.y + int32_t(i) / kSide, z}) != (z < range.first);
    }
    asked += kSamplesPerSquare - square_undefined;
    undefined += square_undefined;
    wrong += square_wrong;
    const std::lock_guard lock(reporting);
    const uint64_t before = done++;
    if (done * 100 / squares != before * 100 / squares) progress("check", double(done) / double(squares));
  });
  return {asked, undefined, wrong};
}

}  // namespace shadewright::voxel
