// RTW (Rosen 2012): tables 1 to 3 and figures 1, 3, 6, 7, 8, 9, the paper's figures beside ours. Its times are of whole
// frames on a GTX 480; ours are compared as ratios to the uniform map of the same run.
#include <fmt/format.h>

#include <algorithm>

#include "bench.h"
#include "shadewright/scene/builtin.h"

namespace shadewright::app {

namespace {

using compare::Outcome;

std::string percent(const Outcome& outcome) {
  return fmt::format("{:.3f} %", 100.0 * outcome.result.error.fraction);
}
double frame(const Outcome& outcome) {
  return outcome.result.frame_milliseconds;
}
std::string effective(const Outcome& outcome) {
  const auto& mer = outcome.result.counters.at("effective_resolution");
  return fmt::format("{:.0f} x {:.0f}", mer[0], mer[1]);
}
std::string ratio(double a, double b) {
  return fmt::format("{:.2f}", a / b);
}

/// "least to greatest".
std::string range(const std::vector<double>& values, int digits) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  return fmt::format("{:.{}f} to {:.{}f}", *least, digits, *greatest, digits);
}

/// The paper's analyses as it has them, and ours as it is by default.
const std::string paper_form = ",collapse=max,px=off,de=on,sn=on,sigma=3,map=2d,cells=512";

struct Row {
  const char* name;
  std::string spec;
  const char* paper[3];  ///< playground, sandbox, town
};

/// Tables 1 and 3: whole frames over the views of the three scenes.
BenchTable frame_table(Bench& bench, const char* title, const std::vector<Row>& rows) {
  BenchTable table{title,
                   "Whole frames, least to greatest over the scene's cameras (paper: over a path), 2048 x 2048; in "
                   "brackets the ratio to the uniform map, of the paper's ranges' middles.",
                   {"technique", "scene", "paper, ms", "paper, of uniform", "ours, ms", "ours, of uniform", "wrong"},
                   {},
                   {}};
  const char* scenes[3] = {"playground", "sandbox", "town"};
  const double paper_uniform[3] = {3.15, 2.0, 2.95};
  for (int s = 0; s < 3; ++s) {
    const Scene scene = make_builtin(scenes[s]);
    std::vector<std::vector<double>> times(rows.size()), ratios(rows.size()), wrong(rows.size());
    for (const Camera& camera : scene.cameras) {
      compare::Study study = bench.study(scene, camera, scene.lights.front());
      double uniform = 0;
      for (size_t r = 0; r < rows.size(); ++r) {
        const Outcome outcome = study.run(shadow::parse_spec(rows[r].spec));
        if (r == 0) uniform = frame(outcome);
        times[r].push_back(frame(outcome));
        ratios[r].push_back(frame(outcome) / uniform);
        wrong[r].push_back(100.0 * outcome.result.error.fraction);
      }
    }
    for (size_t r = 0; r < rows.size(); ++r) {
      double low = 0, high = 0;
      std::string of_uniform = "-";
      if (std::sscanf(rows[r].paper[s], "%lf-%lf", &low, &high) == 2)
        of_uniform = ratio(0.5 * (low + high), paper_uniform[s]);
      table.rows.push_back({rows[r].name, scenes[s], rows[r].paper[s], of_uniform, range(times[r], 1),
                            range(ratios[r], 2), range(wrong[r], 3) + " %"});
    }
  }
  return table;
}

/// Table 2: what each stage costs, one view.
BenchTable stage_table(Bench& bench) {
  BenchTable table{"RTW table 2: stages, playground, ms",
                   "Paper: importance 1.3 (forward), 1.4 (backward), 2.7 (hybrid); warp 0.1, 0.3, 0.4; map 2.2, 2.2, "
                   "2.0 (3.6 to 3.9 tessellated), uniform 1.3; output 1.9, 0.9, 1.1, uniform 1.8. Ours without the "
                   "camera pass, which all have in common.",
                   {"technique", "stage", "ms"},
                   {},
                   {}};
  const Scene scene = make_builtin("playground");
  compare::Study study = bench.study(scene, scene.cameras.front(), scene.lights.front());
  for (const char* analysis : {"forward", "backward", "hybrid"})
    for (const std::string& form : {std::string(), paper_form}) {
      const std::string spec = fmt::format("rtw@2048,analysis={}{}", analysis, form);
      for (const auto& stage : study.run(shadow::parse_spec(spec)).result.milliseconds.stages)
        table.rows.push_back({spec, stage.name, fmt::format("{:.1f}", stage.median)});
    }
  for (const auto& stage : study.run(shadow::parse_spec("sm@2048")).result.milliseconds.stages)
    table.rows.push_back({"sm@2048", stage.name, fmt::format("{:.1f}", stage.median)});
  return table;
}

struct Shown {
  std::string spec;
  const char* paper;  ///< milliseconds and maximum effective resolution
};

/// One figure: techniques on one view, with pictures.
BenchTable figure(Bench& bench, const char* title, const char* note, const char* name, const char* scene_name,
                  const std::vector<Shown>& shown) {
  BenchTable table{title,
                   note,
                   {"technique", "paper", "frame, of the first", "effective resolution", "wrong", "of the first"},
                   {},
                   {}};
  const Scene scene = make_builtin(scene_name);
  compare::Study study = bench.study(scene, scene.cameras.front(), scene.lights.front());
  std::vector<std::string> specs;
  std::transform(shown.begin(), shown.end(), std::back_inserter(specs), [](const Shown& s) { return s.spec; });
  const std::vector<Outcome> outcomes = bench.run(study, specs, name, table);
  const auto wrong = [](const Outcome& o) { return std::max(1.0, static_cast<double>(o.result.error.wrong)); };
  for (size_t i = 0; i < outcomes.size(); ++i)
    table.rows.push_back({specs[i], shown[i].paper, ratio(frame(outcomes[i]), frame(outcomes[0])),
                          effective(outcomes[i]), percent(outcomes[i]), ratio(wrong(outcomes[i]), wrong(outcomes[0]))});
  return table;
}

/// Figure 9: frame times along a path.
BenchTable path_table(Bench& bench) {
  constexpr int stops = 8;
  BenchTable table{
      "RTW figure 9: a path through the town, frame ms",
      "Paper, read off its plot: uniform about 2.7 to 3.2 ms, RTW 3.7 to 4.8 (5 % tessellation 8.4 to 9.5), "
      "CSM of 4 cascades about as RTW without tessellation.",
      {"technique", "least to greatest, ms", "of uniform, mean"},
      {},
      {}};
  const Scene scene = make_builtin("town");
  const CameraPath& path = scene.paths.front();
  const std::vector<std::string> specs = {"sm@2048", "rtw@2048,tessellation=off", "rtw@2048,tessellation=5", "rtw@2048",
                                          "csm@2048"};
  std::vector<std::vector<double>> times(specs.size());
  for (int stop = 0; stop < stops; ++stop) {
    const double share = static_cast<double>(stop) / (stops - 1);
    bench.progress("town, path", share);
    const Camera camera = camera_at(path, path.times.front() + share * (path.times.back() - path.times.front()));
    compare::Study study(bench.device(), scene, camera, scene.lights.front(),
                         {bench.options().width, bench.options().height, bench.options().repeat, 0, false});
    for (size_t i = 0; i < specs.size(); ++i) times[i].push_back(frame(study.run(shadow::parse_spec(specs[i]))));
  }
  for (size_t i = 0; i < specs.size(); ++i) {
    double mean = 0;
    for (size_t k = 0; k < times[i].size(); ++k)
      mean += times[i][k] / times[0][k] / static_cast<double>(times[i].size());
    table.rows.push_back({specs[i], range(times[i], 1), fmt::format("{:.2f}", mean)});
  }
  return table;
}

}  // namespace

void bench_rtw(Bench& bench) {
  bench.add(frame_table(
      bench, "RTW table 1: frames over the views of three scenes",
      {{"uniform", "sm@2048", {"2.7-3.6", "1.9-2.1", "2.7-3.2"}},
       {"forward", "rtw@2048,analysis=forward" + paper_form + ",tessellation=off", {"5.3-7.0", "4.2-5.3", "3.7-4.8"}},
       {"backward", "rtw@2048" + paper_form + ",tessellation=off", {"4.2-5.9", "4.0-5.4", "3.7-4.8"}},
       {"backward, tessellated", "rtw@2048" + paper_form + ",tessellation=2.5", {"6.2-7.3", "6.2-7.1", "11.0-11.5"}},
       {"hybrid", "rtw@2048,analysis=hybrid" + paper_form + ",tessellation=off", {"5.8-7.3", "5.0-5.7", "4.5-5.4"}},
       {"ours", "rtw@2048", {"-", "-", "-"}}}));
  bench.add(stage_table(bench));
  bench.add(frame_table(bench, "RTW table 3: tessellation, backward analysis",
                        {{"uniform", "sm@2048", {"2.7-3.6", "1.9-2.1", "2.7-3.2"}},
                         {"off", "rtw@2048,tessellation=off", {"4.3-5.4", "3.8-4.8", "3.8-5.0"}},
                         {"5 %", "rtw@2048,tessellation=5", {"5.5-6.9", "5.2-5.9", "8.4-9.5"}},
                         {"2.5 %", "rtw@2048,tessellation=2.5", {"5.8-7.0", "5.9-7.0", "10.9-11.9"}},
                         {"1 %", "rtw@2048,tessellation=1", {"6.0-7.2", "8.0-9.5", "16.5-17.4"}},
                         {"exact", "rtw@2048", {"-", "-", "-"}}}));
  bench.add(figure(bench, "RTW figures 1, 2: playground",
                   "The paper's claim: 512 x 512 looks as the uniform 2048 x 2048, 2048 x 2048 nearly as ray tracing.",
                   "rtw-figure-1", "playground",
                   {{"sm@2048,fit=scene", "3.3 ms"},
                    {"rtw@512", "4.2 ms, 2861 x 4083"},
                    {"rtw@512" + paper_form, "4.2 ms, 2861 x 4083"},
                    {"rtw@2048", "5.2 ms, 11448 x 16333"},
                    {"rtw@2048" + paper_form, "5.2 ms, 11448 x 16333"},
                    {"sm@2048,fit=visible", "-"}}));
  bench.add(figure(bench, "RTW figure 3: sandbox", "Importance functions.", "rtw-figure-3", "sandbox",
                   {{"sm@2048,fit=scene", "2.5 ms"},
                    {"rtw@512,collapse=max,px=off,de=on,sigma=3", "3.3 ms, 2114 x 4616"},
                    {"rtw@512,analysis=hybrid,collapse=max,px=off,de=on,sigma=3", "3.5 ms, 2783 x 5628"},
                    {"rtw@512", "-"},
                    {"rtw@512,analysis=hybrid", "-"}}));
  bench.add(figure(bench, "RTW figure 6: importance functions, playground",
                   "Without and with the surface normal; then each function alone and ours.", "rtw-figure-6",
                   "playground",
                   {{"rtw@2048,collapse=max,px=off,de=on,sigma=3", "5.4 ms, 11451 x 20761"},
                    {"rtw@2048,collapse=max,px=off,de=on,sn=on,sigma=3", "4.2 ms, 11447 x 16333"},
                    {"rtw@2048,collapse=max,px=off,sigma=3", "-"},
                    {"rtw@2048,collapse=max,px=on,sigma=3", "-"},
                    {"rtw@2048,collapse=sum,px=off,sn=on,de=on,sigma=3", "-"},
                    {"rtw@2048,collapse=sum,px=on,sigma=3", "-"},
                    {"rtw@2048,rotate=on", "-"},
                    {"rtw@2048", "-"}}));
  bench.add(figure(bench, "RTW figure 7: edges, playground", "Tessellation against errors at large triangles' edges.",
                   "rtw-figure-7", "playground",
                   {{"rtw@1024,tessellation=off", "5.0 ms, 19448 x 36959"},
                    {"rtw@1024,tessellation=2.5", "6.5 ms"},
                    {"rtw@1024", "-"}}));
  bench.add(figure(bench, "RTW figure 8: percentage closer filtering, playground",
                   "A filter of the map's texels smooths edges; one of the world's width makes soft shadows.",
                   "rtw-figure-8", "playground",
                   {{"rtw@1024", "4.8 ms, 11614 x 13650"},
                    {"rectilinear/depth/pcf@1024,radius=2", "7.3 ms"},
                    {"rectilinear/depth/pcf@1024,width=0.1", "7.3 ms"}}));
  bench.add(path_table(bench));
}

}  // namespace shadewright::app
