// The figures of "Perspective Shadow Maps" (2002), as tables: uniform against perspective at 512 and 1024, and what
// people use today beside. The paper prints images only, so there is no figure of its own to stand beside ours.
#include <fmt/format.h>

#include <algorithm>

#include "bench.h"
#include "shadewright/scene/load.h"
#include "shadewright/scene/points.h"

namespace shadewright::app {

namespace {

struct Shot {
  std::string name;
  Camera camera;
  double time = 0;  ///< seconds
};

struct Figure {
  std::string title, note, scene, stem;
  bool points = false;  ///< far instances are drawn as points
};

/// The named cameras, and for moving scenes three moments of their first path.
std::vector<Shot> shots(const Scene& scene, bool along_path) {
  std::vector<Shot> result;
  if (along_path && !scene.paths.empty()) {
    const CameraPath& path = scene.paths.front();
    for (const double share : {0.1, 0.45, 0.8}) {
      const double time = path.times.front() + share * (path.times.back() - path.times.front());
      result.push_back({fmt::format("{} at {:.1f} s", path.name, time), camera_at(path, time), time});
    }
    return result;
  }
  for (const Camera& camera : scene.cameras) result.push_back({camera.name, camera, 0});
  return result;
}

/// The scene as it stands at `time`.
Scene at_time(const Scene& scene, double time) {
  Scene still = scene;
  for (Instance& instance : still.instances) {
    instance.world_from_mesh = transform_at(scene, instance, time);
    instance.motion.reset();
  }
  return still;
}

BenchTable figure_table(Bench& bench, const Figure& figure, bool along_path) {
  BenchTable table{
      figure.title,
      figure.note,
      {"view", "technique", "wrong", "of uniform's", "boundary", "frame", "of uniform's frame", "memory", "fallback"},
      {}};
  const Scene scene = load_scene(figure.scene).scene;
  for (const Shot& shot : shots(scene, along_path)) {
    Scene still = at_time(scene, shot.time);
    if (figure.points) {
      const PointView seen = point_view(shot.camera, bench.options().height);
      PointSummary summary;
      still = with_points(still, std::span(&seen, 1), {}, &summary);
      table.note += fmt::format(" {}: {}", shot.name, describe(summary));
    }
    compare::Study study = bench.study(still, shot.camera, still.lights.front());
    for (const int resolution : {512, 1024}) {
      const std::vector<std::string> specs = {fmt::format("sm@{}", resolution),
                                              fmt::format("psm@{}", resolution),
                                              fmt::format("psm@{},warp=psm", resolution),
                                              fmt::format("psm@{},warp=psm,shift=least,fallback=off", resolution),
                                              fmt::format("psm@{},warp=lispsm", resolution),
                                              fmt::format("cascaded/depth/hard@{}", resolution / 2)};
      const auto outcomes = bench.run(study, specs, fmt::format("{}-{}", figure.stem, shot.name), table);
      const auto& uniform = outcomes.front().result;
      for (const compare::Outcome& outcome : outcomes) {
        const compare::TechniqueResult& result = outcome.result;
        const auto fallback = result.counters.find("fallback");
        table.rows.push_back(
            {shot.name, result.technique, fmt::format("{:.3f} %", 100 * result.error.fraction),
             fmt::format("{:.2f}", static_cast<double>(result.error.wrong) /
                                       static_cast<double>(std::max<uint64_t>(1, uniform.error.wrong))),
             fmt::format("{:.2f} %", 100 * result.error.boundary_fraction),
             fmt::format("{:.0f} ms", result.frame_milliseconds),
             fmt::format("{:.2f}", result.frame_milliseconds / uniform.frame_milliseconds),
             fmt::format("{:.1f} MB", static_cast<double>(result.memory_bytes()) / 1e6),
             fallback == result.counters.end() ? "" : fmt::format("{:.0f}", fallback->second.front())});
      }
    }
  }
  return table;
}

}  // namespace

void bench_psm(Bench& bench) {
  const std::string same =
      "psm is ours: the projection with the smallest texels on the frame's surface points. warp=psm is the paper's, "
      "with the best shift of the eye; with shift=least,fallback=off the eye moves back only as far as the paper asks, "
      "and no uniform map takes the projection's place where that has smaller texels. Cascades have half the "
      "resolution: four of them have as many texels as the map.";
  bench.add(figure_table(bench, {"PSM figure 1: chess board, spot light", same, "builtin:chess", "figure-1"}, false));
  bench.add(figure_table(
      bench, {"PSM figure 8: crowd and trees, far ones as points", same, "builtin:street?crowd=1", "figure-8", true},
      false));
  bench.add(figure_table(
      bench, {"PSM figure 9: street with moving cars and aeroplanes", same, "builtin:street", "figure-9"}, true));
  bench.add(figure_table(
      bench, {"PSM figure 10: ecosystem, points and polygons", same, "builtin:ecosystem", "figure-10", true}, false));
}

}  // namespace shadewright::app
