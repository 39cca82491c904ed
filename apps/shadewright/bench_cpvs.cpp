// The tables of "Compact Precomputed Voxelized Shadows" (2014). Here what needs no device: figure 9, build times,
// look-up ratios; bench_cpvs_device.cpp has the rest.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "bench.h"
#include "bench_cpvs_device.h"
#include "shadewright/compare/metrics.h"
#include "shadewright/raytrace/tracer.h"
#include "shadewright/scene/builtin.h"
#include "shadewright/voxel/bake.h"
#include "shadewright/voxel/check.h"

namespace shadewright::app {

namespace {

constexpr uint32_t width = 1920, height = 1080;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string megabytes(uint64_t bytes) {
  return fmt::format("{:.2f} MB", static_cast<double>(bytes) / 1e6);
}

/// Share of a 16-bit shadow map of that resolution.
std::string compression(uint64_t bytes, uint32_t resolution) {
  return fmt::format("{:.3f} %", 100.0 * static_cast<double>(bytes) / (2.0 * resolution * resolution));
}

/// A row of figure 9: a scene, how it is baked, and the paper's megabytes at some resolutions.
struct Subject {
  const char* name;
  const char* scene;
  voxel::ClosedMode closed;
  bool static_receivers;
  std::vector<std::pair<uint32_t, const char*>> paper;
};

const std::vector<Subject> subjects = {
    {"city, closed",
     "city?triangles=613000",
     voxel::ClosedMode::automatic,
     false,
     {{1024, "202 KB"}, {4096, "1 MB"}, {16384, "6 MB"}, {32768, "13 MB"}, {131072, "50 MB"}, {262144, "100 MB"}}},
    {"city, not closed",
     "city?triangles=613000",
     voxel::ClosedMode::none,
     false,
     {{1024, "489 KB"}, {4096, "4 MB"}, {16384, "36 MB"}, {32768, "96 MB"}, {131072, "639 MB"}}},
    {"landscape, closed",
     "landscape",
     voxel::ClosedMode::automatic,
     false,
     {{1024, "164 KB"},
      {4096, "759 KB"},
      {16384, "3 MB"},
      {32768, "7 MB"},
      {65536, "about 14 MB"},
      {131072, "29 MB"},
      {262144, "61 MB"},
      {1048576, "-"}}},
    {"landscape, not closed",
     "landscape",
     voxel::ClosedMode::none,
     false,
     {{1024, "490 KB"}, {4096, "5 MB"}, {16384, "50 MB"}, {32768, "146 MB"}}},
    {"ruins, not closed",
     "ruins",
     voxel::ClosedMode::none,
     false,
     {{1024, "539 KB"}, {4096, "5 MB"}, {16384, "37 MB"}, {32768, "100 MB"}}},
    {"ruins, static",
     "ruins",
     voxel::ClosedMode::none,
     true,
     {{1024, "444 KB"},
      {4096, "3 MB"},
      {16384, "14 MB"},
      {32768, "31 MB"},
      {65536, "about 0.8 %"},
      {131072, "144 MB"}}},
};

/// The paper's build times of its closed landscape.
std::string paper_seconds(uint32_t resolution) {
  switch (resolution) {
    case 1024:
      return "0.5 s";
    case 4096:
      return "2 s";
    case 16384:
      return "18 s";
    case 32768:
      return "68 s";
    case 65536:
      return "256 s";
    case 131072:
      return "1055 s";
    case 262144:
      return "5520 s";
    default:
      return "-";
  }
}

BenchTable bake_table(const BenchOptions& bench, const Progress& progress) {
  BenchTable table{"CPVS figure 9 and build times: size without the top grid, and seconds to bake",
                   "Paper: its own scenes, from a rendered map; ours: built-in scenes that stand for them, from "
                   "triangles. Percent of a 16-bit map.",
                   {"scene", "resolution", "paper", "ours", "of a 16-bit map", "paper's time (landscape)", "our time",
                    "peak memory"},
                   {}};
  for (const Subject& subject : subjects) {
    const Scene scene = make_builtin(subject.scene);
    for (const auto& [resolution, paper] : subject.paper) {
      if (resolution > bench.limit) continue;
      voxel::BakeOptions options;
      options.resolution = resolution;
      options.closed = subject.closed;
      options.static_receivers = subject.static_receivers;
      progress(fmt::format("{} at {}", subject.name, resolution), 0.0);
      const voxel::BakeResult result = voxel::bake(scene, scene.lights.front(), options);
      table.rows.push_back(
          {subject.name, std::to_string(resolution), paper, megabytes(result.shadow.dag_bytes()),
           compression(result.shadow.dag_bytes(), resolution),
           std::string_view(subject.scene) == "landscape" && subject.closed == voxel::ClosedMode::automatic
               ? paper_seconds(resolution)
               : "-",
           fmt::format("{:.2f} s", result.statistics.seconds), megabytes(result.statistics.peak_bytes)});
    }
  }
  return table;
}

/// First hits of the scene's first camera, as surface points.
std::vector<SurfacePoint> camera_points(const Scene& scene, const Tracer& tracer) {
  const Camera& camera = scene.cameras.front();
  const PixelGrid grid{width, height, camera};
  const auto hits = tracer.primary(grid, near_distance(scene, camera));
  std::vector<SurfacePoint> points(hits.size());
  for (size_t i = 0; i < hits.size(); ++i)
    if (hits[i].distance > 0)
      points[i] = {
          glm::vec3(camera.eye + grid.ray(static_cast<double>(i % width) + 0.5, static_cast<double>(i / width) + 0.5) *
                                     static_cast<double>(hits[i].distance)),
          hits[i].normal};
  return points;
}

template <typename Work>
double median_milliseconds(Work work) {
  std::vector<double> times;
  work();
  for (int i = 0; i < 7; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    times.push_back(1e3 * seconds_since(start));
  }
  std::nth_element(times.begin(), times.begin() + 3, times.end());
  return times[3];
}

/// Look-ups at the camera's points against one shadow ray each, and how often they are wrong.
void lookup_rows(const BenchOptions& bench, const char* name, BenchTable& speed, BenchTable& truth,
                 const Progress& progress) {
  const Scene scene = make_builtin(name);
  const Light& light = scene.lights.front();
  const Tracer tracer(scene);
  const glm::vec3 eye(scene.cameras.front().eye);
  const std::vector<SurfacePoint> points = camera_points(scene, tracer);
  const std::vector<uint8_t> facing = compare::facing_light(points, light);
  std::vector<SurfacePoint> asked;
  for (size_t i = 0; i < points.size(); ++i)
    if (facing[i]) asked.push_back(points[i]);
  const std::vector<uint8_t> reference = tracer.visible(points, eye, light, width);

  voxel::BakeOptions options;
  options.resolution = bench.limit;
  options.max_filter = 17;
  progress(fmt::format("look-ups in {} at {}", name, options.resolution), 0.0);
  const voxel::VoxelShadow shadow = voxel::bake(scene, light, options).shadow;
  std::vector<float> answers(asked.size());
  const double ray = median_milliseconds([&] { tracer.visible(points, eye, light, width); });
  double one_tap = 0;
  for (const auto& [taps, paper] : {std::pair{1u, "1"}, {9u, "2.5"}, {17u, "4.5"}}) {
    const double ms = median_milliseconds([&, taps = taps] { shadow.visibility(asked, taps, answers); });
    if (taps == 1) one_tap = ms;
    speed.rows.push_back({name, std::to_string(options.resolution), fmt::format("{0}x{0}", taps),
                          fmt::format("{:.1f}", ms), paper, fmt::format("{:.2f}", ms / one_tap),
                          fmt::format("{:.2f}", ms / ray)});
  }

  shadow.visibility(asked, 1, answers);
  size_t wrong = 0, next = 0;
  for (size_t i = 0; i < points.size(); ++i)
    if (facing[i]) wrong += (answers[next++] >= 0.5f) != (reference[i] != 0);
  progress(fmt::format("random voxels of {}", name), 0.5);
  const voxel::CheckResult check = voxel::check_shadow(scene, shadow, options, bench.check_voxels);
  truth.rows.push_back({name, std::to_string(options.resolution),
                        fmt::format("{:.3f} %", 100.0 * static_cast<double>(wrong) /
                                                    static_cast<double>(std::max<size_t>(1, asked.size()))),
                        std::to_string(check.asked), std::to_string(check.wrong)});
}

}  // namespace

void bench_cpvs(Bench& bench) {
  bench.add(bake_table(bench.options(), bench.progress()));
  BenchTable speed{
      "CPVS section 7: look-ups on the CPU at 1080p camera points",
      "Paper: on the GPU, worst case over its fly-throughs. The last column is against one coherent Embree shadow ray "
      "a pixel, same points, same run.",
      {"scene", "resolution", "filter", "ms", "paper, of one tap", "ours, of one tap", "of one shadow ray"},
      {}};
  BenchTable truth{"Visibility against ray tracing and against exact depths",
                   "Wrong: share of the camera's points that face the light, one tap. Random voxels: half of them next "
                   "to where visibility changes.",
                   {"scene", "resolution", "wrong", "voxels asked", "disagree"},
                   {}};
  for (const char* name : {"landscape", "city?triangles=613000", "ruins"})
    lookup_rows(bench.options(), name, speed, truth, bench.progress());
  bench.add(std::move(speed));
  bench.add(std::move(truth));
  cpvs_device_tables(bench);
}

}  // namespace shadewright::app
