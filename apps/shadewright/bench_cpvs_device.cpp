// The tables of "Compact Precomputed Voxelized Shadows" (2014) that run on the device: figures 8, 10 and 11, and what
// the order of traversal gains.
#include "bench_cpvs_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "shadewright/compare/path_study.h"
#include "shadewright/files.h"
#include "shadewright/scene/builtin.h"
#include "shadewright/scene/moments.h"
#include "shadewright/voxel/bake.h"
#include "shadewright/voxel/file.h"

namespace shadewright::app {

namespace {

constexpr uint32_t flight_frames = 12;

std::string times(double ratio) {
  return fmt::format("{:.2f}", ratio);
}

std::string milliseconds(double value) {
  return fmt::format("{:.2f}", value);
}

std::vector<shadow::Spec> parse(const std::vector<std::string>& texts) {
  std::vector<shadow::Spec> specs;
  for (const std::string& text : texts) specs.push_back(shadow::parse_spec(text));
  return specs;
}

/// Suns of built-in scenes, each baked once for all filters and all tables, with a pyramid, into the bench's folder.
class Bakes {
 public:
  explicit Bakes(Bench& bench) : bench_(bench) {}

  /// The start of a spec that looks up the sun of `scene`, which `query` made.
  std::string spec(const Scene& scene, const std::string& query,
                   voxel::ClosedMode closed = voxel::ClosedMode::automatic) {
    const std::string stem = file_stem(closed == voxel::ClosedMode::none ? query + "-not-closed" : query);
    const std::filesystem::path file = bench_.options().folder / (stem + ".cpvs");
    if (baked_.insert(stem).second) {
      voxel::BakeOptions options;
      options.resolution = bench_.options().limit;
      options.max_filter = 17;
      options.pyramid = true;
      options.closed = closed;
      voxel::save(voxel::bake(scene, scene.lights.front(), options, bench_.progress()).shadow, file);
    }
    return "cpvs,file=" + file.string();
  }

 private:
  Bench& bench_;
  std::set<std::string> baked_;  ///< file names
};

/// A fly-through: all techniques over the scene's path `main`.
compare::Report fly(Bench& bench, const Scene& scene, const std::vector<std::string>& specs) {
  const BenchOptions& options = bench.options();
  compare::PathStudy study(bench.device(), scene, "main",
                           moments_along(scene.paths.front(), scene.lights.front(), flight_frames),
                           {options.width, options.height, 0, 16, true});
  return study.run(parse(specs), {}, {}, bench.progress());
}

BenchTable flights(Bench& bench, Bakes& bakes) {
  BenchTable table{
      "CPVS figure 8: shading time over fly-throughs",
      "Look-ups alone for the DAG, maps and look-ups for CSM (2048 texels a cascade), as in the paper. Of one "
      "tap: worst frame against worst frame; the paper: at worst 2.5 for 9 x 9 and 4.5 for 17 x 17.",
      {"scene", "technique", "median ms", "worst ms", "of one tap", "of CSM 4", "wrong", "flicker"},
      {}};
  struct Flight {
    const char *name, *scene;
    voxel::ClosedMode closed;
  };
  using enum voxel::ClosedMode;
  for (const Flight& flight : {Flight{"landscape", "landscape", automatic}, Flight{"ruins", "ruins", automatic},
                               Flight{"city, closed", "city?triangles=613000", automatic},
                               Flight{"city, not closed", "city?triangles=613000", none}}) {
    const Scene scene = make_builtin(flight.scene);
    const std::string cpvs = bakes.spec(scene, flight.scene, flight.closed);
    const compare::Report report = fly(bench, scene,
                                       {cpvs, cpvs + ",taps=9", cpvs + ",taps=17", cpvs + ",taps=9,far=mraa",
                                        cpvs + ",taps=9,far=voaa", "csm@2048,cascades=4", "csm@2048,cascades=8"});
    const double one_tap = report.results[0].milliseconds.max, csm = report.results[5].milliseconds.max;
    for (const compare::TechniqueResult& result : report.results)
      table.rows.push_back({flight.name, bench.shown(result.technique), milliseconds(result.milliseconds.median),
                            milliseconds(result.milliseconds.max), times(result.milliseconds.max / one_tap),
                            times(result.milliseconds.max / csm), fmt::format("{:.3f} %", 100 * result.error.fraction),
                            fmt::format("{:.4f}", result.error.flicker.value_or(0))});
  }
  return table;
}

BenchTable filters(Bench& bench) {
  BenchTable table{
      "CPVS figure 10: large filters at 2048 x 2048",
      "Blur and evaluation, without drawing the map, of landscape's camera 'ground'; the paper's milliseconds "
      "are of a GPU: compare the last two columns.",
      {"filter", "technique", "paper ms", "ms", "paper, of the DAG", "ours, of the DAG"},
      {}};
  const Scene scene = make_builtin("landscape");
  compare::Study study = bench.study(scene, scene.cameras.front(), scene.lights.front());
  struct Row {
    const char *filter, *name, *spec;
    double paper;
  };
  double dag = 0;
  for (const Row& row :
       {Row{"9 x 9", "voxel DAG", "cpvs@2048,taps=9", 0.43}, Row{"9 x 9", "shadow map", "pcf@2048,radius=4", 0.52},
        Row{"9 x 9", "variance map", "vsm@2048,blur=4", 0.81}, Row{"17 x 17", "voxel DAG", "cpvs@2048,taps=17", 0.76},
        Row{"17 x 17", "shadow map", "pcf@2048,radius=8", 1.9},
        Row{"17 x 17", "variance map", "vsm@2048,blur=8", 1.01}}) {
    const compare::TechniqueResult result = study.run(shadow::parse_spec(row.spec)).result;
    double spent = 0;
    for (const auto& stage : result.milliseconds.stages)
      if (stage.name == "look-up" || stage.name == "blur") spent += stage.median;
    const bool is_dag = std::string_view(row.name) == "voxel DAG";
    if (is_dag) dag = spent;
    const double paper_dag = std::string_view(row.filter) == "9 x 9" ? 0.43 : 0.76;
    table.rows.push_back({row.filter, row.name, fmt::format("{:.2f}", row.paper), milliseconds(spent),
                          times(row.paper / paper_dag), times(spent / dag)});
  }
  return table;
}

BenchTable orders(Bench& bench, Bakes& bakes) {
  BenchTable table{"CPVS section 7: what the order of traversal gains",
                   "Worst frame of the fly-through: the best order, and each leaf on its own, against x always first. "
                   "Paper, best order: 7.5 and 10.8 % in its closed city, 14.2 and 26.6 % in Necropolis.",
                   {"scene", "filter", "fixed ms", "best ms", "gain", "leaves ms", "gain of leaves"},
                   {}};
  for (const char* name : {"city?triangles=613000", "ruins"}) {
    const Scene scene = make_builtin(name);
    std::vector<std::string> specs;
    for (const char* taps : {"9", "17"})
      for (const char* order : {"fixed", "best", "leaves"})
        specs.push_back(fmt::format("{},taps={},order={}", bakes.spec(scene, name), taps, order));
    const compare::Report report = fly(bench, scene, specs);
    for (const auto& [first, taps] : {std::pair<size_t, const char*>{0, "9"}, {3, "17"}}) {
      const auto worst = [&, first = first](size_t order) { return report.results[first + order].milliseconds.max; };
      table.rows.push_back({name, fmt::format("{0} x {0}", taps), milliseconds(worst(0)), milliseconds(worst(1)),
                            fmt::format("{:.1f} %", 100 * (1 - worst(1) / worst(0))), milliseconds(worst(2)),
                            fmt::format("{:.1f} %", 100 * (1 - worst(2) / worst(0)))});
    }
  }
  return table;
}

BenchTable distant(Bench& bench, Bakes& bakes) {
  BenchTable table{
      "CPVS figure 11, bottom: distant shadows",
      "ruins from ten times as far as its camera 'overview'. Mean absolute error is against 16 shadow rays in "
      "each pixel's footprint.",
      {"technique", "mean absolute", "wrong"},
      {}};
  const Scene scene = make_builtin("ruins");
  Camera far = find_camera(scene, "overview");
  far.eye = far.target + 10.0 * (far.eye - far.target);
  far.fov_y /= 6;
  compare::Study study = bench.study(scene, far, scene.lights.front());
  const std::string spec = bakes.spec(scene, "ruins") + ",taps=9";
  for (const compare::Outcome& outcome :
       bench.run(study, {spec, spec + ",far=voaa", spec + ",far=mraa"}, "distant", table))
    table.rows.push_back({bench.shown(outcome.result.technique),
                          fmt::format("{:.5f}", outcome.result.error.mean_absolute),
                          fmt::format("{:.3f} %", 100 * outcome.result.error.fraction)});
  return table;
}

BenchTable quality(Bench& bench, Bakes& bakes) {
  BenchTable table{"CPVS figure 11, top: filtering quality",
                   "Paper: 1.8, 2.4 and 0.47 ms.",
                   {"technique", "ms", "of the DAG", "wrong", "mean absolute"},
                   {}};
  const Scene scene = make_builtin("ruins");
  compare::Study study = bench.study(scene, scene.cameras.front(), scene.lights.front());
  const std::string spec = bakes.spec(scene, "ruins") + ",taps=9";
  const auto outcomes = bench.run(study, {"csm@2048,cascades=4", "csm@2048,cascades=8", spec}, "quality", table);
  for (const compare::Outcome& outcome : outcomes)
    table.rows.push_back({bench.shown(outcome.result.technique), milliseconds(outcome.result.milliseconds.median),
                          times(outcome.result.milliseconds.median / outcomes.back().result.milliseconds.median),
                          fmt::format("{:.3f} %", 100 * outcome.result.error.fraction),
                          fmt::format("{:.5f}", outcome.result.error.mean_absolute)});
  return table;
}

}  // namespace

void cpvs_device_tables(Bench& bench) {
  Bakes bakes(bench);
  bench.add(flights(bench, bakes));
  bench.add(filters(bench));
  bench.add(orders(bench, bakes));
  bench.add(quality(bench, bakes));
  bench.add(distant(bench, bakes));
}

}  // namespace shadewright::app
