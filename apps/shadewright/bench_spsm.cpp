// The tables of "Sub-Pixel Shadow Mapping" (2014): tables 1 and 2, the matches of figure 12, and figures 2, 6 and 13.
#include <fmt/format.h>

#include <algorithm>

#include "bench.h"
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
std::string overhead(const Outcome& plain, const Outcome& other) {
  return fmt::format("{:.0f} %", 100 * (other.result.frame_milliseconds / plain.result.frame_milliseconds - 1));
}

const Camera& camera_of(const Scene& scene, const std::string& name) {
  for (const Camera& camera : scene.cameras)
    if (camera.name == name) return camera;
  throw InputError(scene.name, "it has no camera '" + name + "'", "name another");
}

struct Subject {
  const char *name, *scene, *camera, *paper_1024, *paper_2048;  ///< milliseconds, plain and sub-pixel
};
constexpr Subject subjects[] = {{"spheres", "spheres", "near", "5.0, 6.8 (36 %)", "6.8, 8.6 (26 %)"},
                                {"lattice", "lattice", "near", "5.8, 9.1 (57 %)", "7.4, 10.7 (45 %)"},
                                {"city", "city?triangles=2300000", "street", "31.2, 40.0 (28 %)", "32.2, 41.6 (29 %)"}};

/// Table 1 and figure 12, which look at the same frames.
std::vector<BenchTable> scenes(Bench& bench) {
  BenchTable times{"Table 1: frame times",
                   "Whole frames in milliseconds, camera pass included; the paper's on a GeForce GTX 580.",
                   {"scene", "triangles", "map", "sm", "spsm", "overhead", "paper: sm, spsm"},
                   {}};
  BenchTable matches{"Figure 12: match with ray tracing",
                     "The paper's 2048 image matches in 97.93 % (plain) and 99.63 % (sub-pixel) of its pixels.",
                     {"scene", "map", "sm", "spsm", "wrong pixels, sm to spsm"},
                     {}};
  for (const Subject& subject : subjects) {
    const Scene scene = make_builtin(subject.scene);
    compare::Study study = bench.study(scene, camera_of(scene, subject.camera), scene.lights.front());
    const auto found = bench.run(study, {"sm@1024", "spsm@1024", "sm@2048", "spsm@2048"}, subject.name, matches);
    for (size_t i = 0; i < 4; i += 2) {
      const std::string map = i == 0 ? "1024" : "2048";
      times.rows.push_back({subject.name, std::to_string(study.report().triangles), map, frame_time(found[i]),
                            frame_time(found[i + 1]), overhead(found[i], found[i + 1]),
                            i == 0 ? subject.paper_1024 : subject.paper_2048});
      matches.rows.push_back(
          {subject.name, map, match(found[i]), match(found[i + 1]), times_wrong(found[i], found[i + 1])});
    }
  }
  return {times, matches};
}

/// Table 2 and figures 2, 6 and 13, on the lattice.
std::vector<BenchTable> variants(Bench& bench) {
  const Scene scene = make_builtin("lattice");
  compare::Study study = bench.study(scene, camera_of(scene, "near"), scene.lights.front());
  BenchTable sizes{"Table 2: overhead by the map's size",
                   "On lattice; the paper's on YeahRight.",
                   {"map", "sm", "spsm", "overhead", "paper: sm, spsm, overhead"},
                   {}};
  constexpr std::pair<const char*, const char*> paper[] = {{"512", "5.5, 10.0, 81 %"},
                                                           {"1024", "5.8, 9.1, 56 %"},
                                                           {"2048", "7.4, 10.7, 44 %"},
                                                           {"4096", "14.2, 18.1, 27 %"}};
  for (const auto& [size, figures] : paper) {
    const auto found =
        bench.run(study, {fmt::format("sm@{}", size), fmt::format("spsm@{}", size)}, "lattice-size", sizes);
    sizes.rows.push_back({size, frame_time(found[0]), frame_time(found[1]), overhead(found[0], found[1]), figures});
  }
  BenchTable others{
      "Figures 2, 6 and 13: what each part brings",
      "On lattice with maps of 512: without recovery, with the slope codes of the paper and of its straw man, "
      "and the triangles of RGSM.",
      {"technique", "wrong pixels", "false shadow", "false lit", "inside, false shadow", "frame"},
      {}};
  const std::vector<std::string> specs{
      "sm@512",   "spsm@512",         "spsm@512,recovery=off", "spsm@512,slopes=power", "spsm@512,slopes=linear",
      "rgsm@512", "rgsm@512,kernel=5"};
  for (const Outcome& outcome : bench.run(study, specs, "lattice", others)) {
    const auto& error = outcome.result.error;
    others.rows.push_back({outcome.result.technique, std::to_string(error.wrong), std::to_string(error.false_shadow),
                           std::to_string(error.false_lit), std::to_string(error.interior_false_shadow),
                           frame_time(outcome)});
  }
  return {sizes, others};
}

}  // namespace

std::vector<BenchTable> bench_spsm(Bench& bench) {
  std::vector<BenchTable> tables = scenes(bench);
  for (BenchTable& table : variants(bench)) tables.push_back(std::move(table));
  return tables;
}

}  // namespace shadewright::app
