// Both paths on every built-in scene, in all voxels that are defined: the real path from the triangles, the reference
// path from the map of exact depths. 512 and 1024 voxels an axis, and ten million random voxels of each scene at its
// full size, take minutes and are run by hand: voxel_test --gtest_also_run_disabled_tests
// --gtest_filter='*BuiltinAgreement*'
#include <gtest/gtest.h>

#include <cstdio>

#include "direct.h"
#include "lookup.h"
#include "shadewright/scene/builtin.h"
#include "shadewright/voxel/bake.h"
#include "shadewright/voxel/check.h"

namespace shadewright::voxel {
namespace {

/// Defined voxels in which `shadow` is not what the ranges (all texels, row by row) say.
uint64_t disagreements(const VoxelShadow& shadow, std::span<const TexelRange> ranges) {
  const uint32_t size = shadow.light().size();
  uint64_t wrong = 0;
  for (uint32_t y = 0; y < size; y += 8)
    for (uint32_t x = 0; x < size; x += 8)
      for (uint32_t z = 0; z < size; ++z) {
        const uint64_t leaf = find_leaf(shadow.dags()[0], x, y, z);
        for (uint32_t t = 0; t < 64; ++t) {
          const TexelRange& range = ranges[size_t(y + t / 8) * size + x + t % 8];
          const bool visible = leaf >> t & 1;
          wrong += visible ? int32_t(z) >= range.limit : int32_t(z) < range.first;
        }
      }
  return wrong;
}

/// The parameters keep the large scenes small.
std::string small_scene(const BuiltinScene& scene) {
  for (const BuiltinParameter& parameter : scene.parameters)
    if (parameter.key == "triangles") return scene.name + "?triangles=" + std::to_string(parameter.min);
  return scene.name;
}

Light first_light(const Scene& scene) {
  for (const Light& own : scene.lights)
    if (own.kind != LightKind::point) return own;
  Light light;
  light.direction = glm::normalize(glm::dvec3(0.4, -1, 0.3));
  return light;
}

void expect_agreement(uint32_t resolution) {
  for (const BuiltinScene& builtin : builtin_scenes()) {
    SCOPED_TRACE(builtin.name);
    const Scene scene = make_builtin(small_scene(builtin));
    const Light light = first_light(scene);
    BakeOptions options;
    options.resolution = resolution;
    const VoxelShadow real = bake(scene, light, options).shadow;
    const LightGrid& grid = real.light();
    const Casters casters = gather_casters(scene);
    const SnappedCasters snapped = snap(casters, find_topology(casters, scene, options.closed), grid);
    const DirectDepths direct(snapped, grid,
                              {options.static_receivers, options.max_filter, filter_margin(grid, options.max_filter)});
    const auto size = int32_t(grid.size());
    const std::vector<TexelRange> ranges = direct.ranges(0, 0, size, size);
    EXPECT_EQ(disagreements(real, ranges), 0u);
    std::vector<float> depth, exit;
    for (const TexelRange& range : ranges) {
      depth.push_back(float(range.first) / float(size));
      exit.push_back(float(range.limit) / float(size));
    }
    EXPECT_EQ(disagreements(bake_depth_map(depth, exit, grid, options.max_filter), ranges), 0u);
  }
}

TEST(BuiltinAgreement, At256) {
  expect_agreement(256);
}

TEST(BuiltinAgreement, DISABLED_At512) {
  expect_agreement(512);
}

TEST(BuiltinAgreement, DISABLED_At1024) {
  expect_agreement(1024);
}

TEST(BuiltinAgreement, DISABLED_RandomVoxels) {
  for (const BuiltinScene& builtin : builtin_scenes()) {
    SCOPED_TRACE(builtin.name);
    const Scene scene = make_builtin(builtin.name);
    BakeOptions options;
    options.resolution = 16384;
    const VoxelShadow shadow = bake(scene, first_light(scene), options).shadow;
    const CheckResult check = check_shadow(scene, shadow, options, 10'000'000);
    std::printf("%s: %zu asked, %zu undefined\n", builtin.name.c_str(), size_t(check.asked), size_t(check.undefined));
    EXPECT_EQ(check.wrong, 0u);
  }
}

}  // namespace
}  // namespace shadewright::voxel
