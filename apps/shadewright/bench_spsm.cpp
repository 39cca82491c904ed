// The tables of "Sub-Pixel Shadow Mapping" (2014): tables 1 and 2, the matches of figure 12, figures 2, 6, 11, 13 and
// 14, how steady shadows are as the light moves, and the combinations that section 2 proposes.
#include <fmt/format.h>

#include <algorithm>

#include "bench.h"
#include "shadewright/compare/path_study.h"
#include "shadewright/error.h"
#include "shadewright/scene/builtin.h"

namespace shadewright::app {

namespace {

using compare::Outcome;

std::string frame_time(const Outcome& outcome) {
  return fmt::format("{:.1f}", outcome.result.frame_milliseconds);
}
std::string match(const Outcome& outcome) {
  return fmt::format("{:.2f} %", 100 * outcome.result.error.match);
}
/// How many times as many pixels are wrong in `a` as in `b`.
std::string times_wrong(const Outcome& a, const Outcome& b) {
  return fmt::format("{:.1f}x", static_cast<double>(a.result.error.wrong) /
                                    static_cast<double>(std::max<uint64_t>(b.result.error.wrong, 1)));
}
/// Milliseconds of one of its stages.
double stage(const Outcome& outcome, std::string_view name) {
  for (const auto& found : outcome.result.milliseconds.stages)
    if (found.name == name) return found.median;
  return 0;
}
std::string overhead(const Outcome& plain, const Outcome& other) {
  return fmt::format("{:.0f} %", 100 * (other.result.frame_milliseconds / plain.result.frame_milliseconds - 1));
}

/// Of table 1.
struct Subject {
  const char *name, *scene, *camera, *paper_1024, *paper_2048;  ///< milliseconds, plain and sub-pixel
};
constexpr Subject subjects[] = {{"spheres", "spheres", "near", "5.0, 6.8 (36 %)", "6.8, 8.6 (26 %)"},
                                {"lattice", "lattice", "near", "5.8, 9.1 (57 %)", "7.4, 10.7 (45 %)"},
                                {"city", "city?triangles=2300000", "street", "31.2, 40.0 (28 %)", "32.2, 41.6 (29 %)"}};

BenchTable frame_times(Bench& bench) {
  BenchTable table{"Table 1: frame times",
                   "Whole frames in milliseconds, camera pass included; the paper's on a GeForce GTX 580.",
                   {"scene", "triangles", "map", "sm", "spsm", "overhead", "paper: sm, spsm"},
                   {}};
  for (const Subject& subject : subjects) {
    const Scene scene = make_builtin(subject.scene);
    compare::Study study = bench.study(scene, find_camera(scene, subject.camera), scene.lights.front());
    const auto found = bench.run(study, {"sm@1024", "spsm@1024", "sm@2048", "spsm@2048"}, subject.name, table);
    for (size_t i = 0; i < 4; i += 2)
      table.rows.push_back({subject.name, std::to_string(study.report().triangles), i == 0 ? "1024" : "2048",
                            frame_time(found[i]), frame_time(found[i + 1]), overhead(found[i], found[i + 1]),
                            i == 0 ? subject.paper_1024 : subject.paper_2048});
  }
  return table;
}

/// A view framed so that the plain map matches ray tracing in about as many pixels as the paper's does.
struct FramedView {
  const char *name, *scene;
  glm::dvec3 eye, target;
  double fov_degrees;

  Camera camera() const {
    Camera result;
    result.name = "framed";
    result.eye = eye;
    result.target = target;
    result.fov_y = glm::radians(fov_degrees);
    return result;
  }
};
const FramedView framed_views[] = {{"spheres", "spheres", {-2.82, 0.13, -1.7}, {-2.921, 0, -1.802}, 21},
                                   {"lattice", "lattice", {0.2, 1.1, 0.75}, {-0.1, 0.85, 0.1}, 16},
                                   {"city", "city?triangles=200000", {1.4, 1.2, 29}, {3.15, 0.15, 27.6}, 22}};

BenchTable matches(Bench& bench) {
  BenchTable table{
      "Figure 12: match with ray tracing",
      "Maps of 2048 fitted to the scene, close-ups framed for a match of sm near the paper's: 97.93 % (plain) "
      "and 99.63 % (sub-pixel).",
      {"scene", "sm", "rgsm", "spsm, tangents", "spsm", "wrong, sm to spsm", "wrong, rgsm to spsm"},
      {}};
  for (const FramedView& view : framed_views) {
    const Scene scene = make_builtin(view.scene);
    compare::Study study = bench.study(scene, view.camera(), scene.lights.front());
    const auto found = bench.run(
        study,
        {"sm@2048,fit=scene", "rgsm@2048,fit=scene", "spsm@2048,fit=scene,recovery=tangents", "spsm@2048,fit=scene"},
        std::string(view.name) + "-framed", table);
    table.rows.push_back({view.name, match(found[0]), match(found[1]), match(found[2]), match(found[3]),
                          times_wrong(found[0], found[3]), times_wrong(found[1], found[3])});
  }
  return table;
}

/// Table 2 and figures 2, 6 and 13, on the lattice.
void variants(Bench& bench) {
  const Scene scene = make_builtin("lattice");
  compare::Study study = bench.study(scene, find_camera(scene, "near"), scene.lights.front());
  BenchTable sizes{
      "Table 2 and figure 14: overhead by the map's size, and how pixels are decided",
      "On lattice; the paper's on YeahRight.",
      {"map", "sm", "spsm", "overhead", "by one texel", "by 3x3", "by recovery", "paper: sm, spsm, overhead"},
      {}};
  constexpr std::pair<const char*, const char*> paper[] = {{"512", "5.5, 10.0, 81 %"},
                                                           {"1024", "5.8, 9.1, 56 %"},
                                                           {"2048", "7.4, 10.7, 44 %"},
                                                           {"4096", "14.2, 18.1, 27 %"}};
  for (const auto& [size, figures] : paper) {
    const auto found =
        bench.run(study, {fmt::format("sm@{}", size), fmt::format("spsm@{}", size)}, "lattice-size", sizes);
    std::vector<std::string> row{size, frame_time(found[0]), frame_time(found[1]), overhead(found[0], found[1])};
    for (const char* way : {"decided_by_one_texel", "decided_by_neighbours", "decided_by_recovery"})
      row.push_back(fmt::format("{:.2f} %", 100 * found[1].result.counters.at(way).front() /
                                                static_cast<double>(found[1].result.error.compared)));
    row.emplace_back(figures);
    sizes.rows.push_back(std::move(row));
  }
  bench.add(std::move(sizes));
  BenchTable others{"Figures 2, 6 and 13: what each part brings",
                    "On lattice with maps of 512: without recovery, by the paper's tangents, with the slope codes of "
                    "the paper and of "
                    "its straw man, and the triangles of RGSM.",
                    {"technique", "wrong pixels", "false shadow", "false lit", "inside, false shadow", "frame"},
                    {}};
  const std::vector<std::string> specs{"sm@512",
                                       "spsm@512",
                                       "spsm@512,recovery=off",
                                       "spsm@512,recovery=tangents",
                                       "spsm@512,slopes=power",
                                       "spsm@512,slopes=linear",
                                       "rgsm@512",
                                       "rgsm@512,kernel=5"};
  for (const Outcome& outcome : bench.run(study, specs, "lattice", others)) {
    const auto& error = outcome.result.error;
    others.rows.push_back({outcome.result.technique, std::to_string(error.wrong), std::to_string(error.false_shadow),
                           std::to_string(error.false_lit), std::to_string(error.interior_false_shadow),
                           frame_time(outcome)});
  }
  bench.add(std::move(others));
  BenchTable smooth{"Figure 11: anti-aliasing",
                    "On lattice; mean difference from 16 rays a pixel. The paper's frame goes from 9.0 to 9.3 ms.",
                    {"technique", "mean absolute", "look-up", "frame"},
                    {}};
  for (const Outcome& outcome : bench.run(study, {"spsm@1024", "uniform/subpixel/aa@1024", "pcf@1024"}, "aa", smooth))
    smooth.rows.push_back({outcome.result.technique, fmt::format("{:.5f}", outcome.result.error.mean_absolute),
                           fmt::format("{:.1f}", stage(outcome, "look-up")), frame_time(outcome)});
  bench.add(std::move(smooth));
}

/// Section 6.4's two artefacts, on its own subjects: leaves (figure 15) and fine struts.
BenchTable artefacts(Bench& bench) {
  BenchTable table{
      "Section 6.4: holes and fusion",
      "Holes between look-ups show as false light, occluders fused within a texel as false shadow; pixels.",
      {"scene", "technique", "holes", "of them inside shadows", "fusion", "of it inside lit faces"},
      {}};
  for (const char* name : {"trees", "lattice"}) {
    const Scene scene = make_builtin(name);
    compare::Study study = bench.study(scene, scene.cameras.front(), scene.lights.front());
    const std::vector<std::string> specs{"spsm@1024,recovery=tangents", "spsm@1024", "spsm@2048"};
    for (const Outcome& outcome : bench.run(study, specs, fmt::format("artefacts-{}", name), table)) {
      const auto& error = outcome.result.error;
      table.rows.push_back({name, outcome.result.technique, std::to_string(error.false_lit),
                            std::to_string(error.interior_false_lit), std::to_string(error.false_shadow),
                            std::to_string(error.interior_false_shadow)});
    }
  }
  return table;
}

/// Section 6.2's claim of steady shadows: the sun turns by a tenth of a degree a frame.
BenchTable steadiness(Bench& bench) {
  BenchTable table{"Steadiness: the sun turns over spheres by a tenth of a degree a frame",
                   "Flicker: the share of surface points whose wrongness changes from one frame to the next.",
                   {"technique", "wrong", "flicker"},
                   {}};
  const Scene scene = make_builtin("spheres");
  const Light light = scene.lights.front();
  constexpr uint32_t frames = 10;
  std::vector<Moment> moments(frames, Moment{0, find_camera(scene, "near"), light});
  const glm::dvec2 from = sun_angles(light);
  turn_sun(moments, from, from + glm::dvec2(0.1 * (frames - 1), 0));
  bench.progress("steadiness", 0);
  compare::PathStudy study(bench.device(), scene, "sun", moments,
                           {bench.options().width, bench.options().height, 1, 0, true});
  std::vector<shadow::Spec> specs;
  for (const char* spec : {"sm@1024", "rgsm@1024", "spsm@1024"}) specs.push_back(shadow::parse_spec(spec));
  for (const auto& result : study.run(specs).results)
    table.rows.push_back({result.technique, fmt::format("{:.4f} %", 100 * result.error.fraction),
                          fmt::format("{:.4f} %", 100 * result.error.flicker.value_or(0))});
  return table;
}

/// Sub-pixel texels under the other parameterizations, beside both parents.
BenchTable combinations(Bench& bench) {
  BenchTable table{"Combinations: each beside both its parents",
                   "Edge: wrong pixels within 3 pixels of a true shadow edge. Maps of 1024; cascades of 512.",
                   {"scene", "technique", "wrong", "edge", "frame", "memory"},
                   {}};
  for (const char* name : {"city?triangles=200000", "street"}) {
    const Scene scene = make_builtin(name);
    compare::Study study = bench.study(scene, scene.cameras.front(), scene.lights.front());
    std::vector<std::string> specs{"spsm@1024"};
    for (const char* maps : {"perspective/{}/hard@1024", "cascaded/{}/hard@512"})
      for (const char* storage : {"depth", "subpixel"}) specs.push_back(fmt::format(fmt::runtime(maps), storage));
    for (const Outcome& outcome : bench.run(study, specs, fmt::format("combinations-{}", scene.name), table))
      table.rows.push_back({scene.name, outcome.result.technique,
                            fmt::format("{:.3f} %", 100 * outcome.result.error.fraction),
                            fmt::format("{:.2f} %", 100 * outcome.result.error.boundary_fraction), frame_time(outcome),
                            fmt::format("{:.1f} MB", static_cast<double>(outcome.result.memory_bytes()) / 1e6)});
  }
  return table;
}

}  // namespace

void bench_spsm(Bench& bench) {
  bench.add(frame_times(bench));
  bench.add(matches(bench));
  variants(bench);
  bench.add(artefacts(bench));
  bench.add(steadiness(bench));
  bench.add(combinations(bench));
}

}  // namespace shadewright::app
