// The tables of "Resolution-Matched Shadow Maps" (2007), the paper's figures beside ours. Ratios to the standard shadow
// map are what compares: the paper's frames are a GeForce 7800 GTX's.
#include <fmt/format.h>

#include <algorithm>

#include "bench.h"
#include "shadewright/scene/builtin.h"

namespace shadewright::app {

namespace {

using Outcomes = std::vector<compare::Outcome>;

/// A view that stands for one of the paper's, and the paper's figures of it.
struct PaperView {
  const char *name, *scene, *camera;
  const char *sm, *iterative_static, *rmsm_static, *iterative_dynamic, *rmsm_dynamic;  ///< figure 8, frames a second
  const char *pages_iterative, *pages_rmsm;                                            ///< figure 12(a)
};
const std::vector<PaperView> views = {
    {"robot", "characters", "near", "80-100", "11-15", "30-32", "4-7", "13-24", "737-2467", "3294-4666"},
    {"skeletons", "characters", "main", "80-100", "16-20", "34-38", "7-8", "16-20", "1300-2200", "2900-5600"},
    {"trees", "trees", "wide", "80-100", "12-18", "30-35", "6-7", "13-14", "2300-5500", "3800-5900"},
    {"city", "city?triangles=58000", "street", "80-100", "11-13", "20-25", "6-8", "16-28", "1300-2900", "3800-7100"},
    {"furball-W", "furball", "wall", "80-100", "20-30", "30-35", "2-3", "20-25", "1300-5000", "4800-5900"},
    {"furball-F", "furball", "furball", "80-100", "7-10", "15-17", "4-5", "6-7", "1300-5000", "4800-5900"}};

double counter(const compare::Outcome& outcome, const char* name) {
  return outcome.result.counters.at(name).front();
}

std::string milliseconds(const compare::Outcome& outcome, const compare::Outcome& sm) {
  const double frame = outcome.result.frame_milliseconds;
  return fmt::format("{:.0f} ms ({:.2f}x)", frame, frame / sm.result.frame_milliseconds);
}

std::string whole(double value) {
  return fmt::format("{:.0f}", value);
}

std::string wrong_a_pixel_of_edge(const compare::Outcome& outcome) {
  const auto& error = outcome.result.error;
  return fmt::format("{:.3f}",
                     static_cast<double>(error.wrong) / std::max(1.0, static_cast<double>(error.edge_pixels)));
}

std::string megabytes(const compare::Outcome& outcome) {
  return fmt::format("{:.0f} MB", static_cast<double>(outcome.result.memory_bytes()) / 1e6);
}

Outcomes run(Bench& bench, const Scene& scene, const char* camera, const std::vector<std::string>& specs,
             const std::string& stem, BenchTable& table, std::optional<uint32_t> size = {}) {
  compare::Study study = bench.study(scene, find_camera(scene, camera), scene.lights.front(), size);
  return bench.run(study, specs, stem, table);
}

/// Figures 8, 11 to 13 from the same runs.
void views_tables(Bench& bench) {
  BenchTable speed{
      "Figure 8: frames of standard, adaptive and resolution-matched maps",
      "Whole frames in milliseconds and as ratios to the 2048 standard map of the same run; in brackets the "
      "paper's frames a second (its standard map: 80-100 in every row). Static: pages kept (cache=on).",
      {"view", "sm@2048", "ASM static", "RMSM static", "ASM dynamic", "RMSM dynamic", "ASM / RMSM, dynamic"},
      {}};
  BenchTable memory{"Figure 12(a): pages",
                    "Pages of 32 x 32 texels that a frame draws from nothing.",
                    {"view", "ASM", "paper", "RMSM", "paper"},
                    {}};
  BenchTable use{
      "Figures 13 and 14: how much of the pages is used",
      "The share of the drawn texels that the look-up reads. Paper: 50 to 70 % for coherent receivers, 10 to 30 % "
      "for hair and leaves; about half on average.",
      {"view", "used texels", "taps", "by a coarser page", "unserved"},
      {}};
  BenchTable errors{"Errors (not in the paper)",
                    "Wrong pixels for each pixel of true shadow edge.",
                    {"view", "sm@2048", "ASM", "RMSM", "RMSM, one texel", "oracle fraction"},
                    {}};
  for (const PaperView& view : views) {
    const Scene scene = make_builtin(view.scene);
    const Outcomes o =
        run(bench, scene, view.camera,
            {"sm@2048", "asm", "asm,cache=on", "rmsm", "rmsm,cache=on", "rmsm,statistics=on", "paged/depth/hard"},
            view.name, speed);
    const auto with = [](const std::string& ours, const char* paper) { return fmt::format("{} [{}]", ours, paper); };
    speed.rows.push_back(
        {view.name, with(milliseconds(o[0], o[0]), view.sm), with(milliseconds(o[2], o[0]), view.iterative_static),
         with(milliseconds(o[4], o[0]), view.rmsm_static), with(milliseconds(o[1], o[0]), view.iterative_dynamic),
         with(milliseconds(o[3], o[0]), view.rmsm_dynamic),
         fmt::format("{:.2f}", o[1].result.frame_milliseconds / o[3].result.frame_milliseconds)});
    memory.rows.push_back({view.name, whole(counter(o[1], "pages")), view.pages_iterative,
                           whole(counter(o[3], "pages")), view.pages_rmsm});
    use.rows.push_back({view.name, fmt::format("{:.0f} %", 100 * counter(o[5], "page_utilization")),
                        whole(counter(o[5], "taps")), whole(counter(o[5], "coarser_taps")),
                        whole(counter(o[5], "unserved_taps"))});
    errors.rows.push_back({view.name, wrong_a_pixel_of_edge(o[0]), wrong_a_pixel_of_edge(o[1]),
                           wrong_a_pixel_of_edge(o[3]), wrong_a_pixel_of_edge(o[6]),
                           fmt::format("{:.5f}", o[6].result.error.oracle_fraction.value_or(0))});
  }
  for (BenchTable* table : {&speed, &memory, &use, &errors}) bench.add(std::move(*table));
}

/// Figures 9, 10 and 12(b): image sizes, and three views of trees.
BenchTable scaling_table(Bench& bench) {
  BenchTable table{"Figures 9, 10 and 12(b): image sizes, and three views of trees",
                   "Dynamic frames. In brackets the paper's pages (iterative, resolution-matched).",
                   {"view", "image", "sm@2048", "ASM", "RMSM", "pages ASM", "pages RMSM"},
                   {}};
  struct Row {
    const char *scene, *camera;
    uint32_t size;
    const char *pages_iterative, *pages_rmsm;
  };
  for (const Row& row : {Row{"furball", "wall", 512, "539", "1376"}, Row{"furball", "furball", 512, "3506", "3948"},
                         Row{"furball", "wall", 1024, "1446", "4886"}, Row{"furball", "furball", 1024, "5056", "5472"},
                         Row{"trees", "wide", 1024, "-", "-"}, Row{"trees", "under", 1024, "-", "-"},
                         Row{"trees", "crown", 1024, "-", "-"}}) {
    const Scene scene = make_builtin(row.scene);
    const std::string name = fmt::format("{} {}", row.scene, row.camera);
    const Outcomes o = run(bench, scene, row.camera, {"sm@2048", "asm", "rmsm"}, fmt::format("{} {}", name, row.size),
                           table, row.size);
    table.rows.push_back({name, fmt::format("{}^2", row.size), milliseconds(o[0], o[0]), milliseconds(o[1], o[0]),
                          milliseconds(o[2], o[0]),
                          fmt::format("{:.0f} [{}]", counter(o[1], "pages"), row.pages_iterative),
                          fmt::format("{:.0f} [{}]", counter(o[2], "pages"), row.pages_rmsm)});
  }
  return table;
}

/// Figures 15 and 16: quality, time and memory against the finest resolution and the analysis' resolution.
BenchTable quality_table(Bench& bench) {
  BenchTable table{
      "Figures 15 and 16: quality against the finest resolution and the analysis' resolution",
      "The trees from below; dynamic frames. The pool's size stays the same; pages is what is used of it. Paper: "
      "21.3, 17.3 and 16.3 MB.",
      {"spec", "frame", "pages", "memory", "wrong a pixel of edge"},
      {}};
  const Scene scene = make_builtin("trees");
  const std::vector<std::string> specs{"sm@2048",
                                       "rmsm,finest=8192",
                                       "rmsm,finest=16384",
                                       "rmsm",
                                       "rmsm@131072",
                                       "rmsm,analysis_scale=2",
                                       "rmsm,analysis_scale=4",
                                       "rmsm,analysis_scale=8",
                                       "rmsm,analysis_scale=8,finest=8192",
                                       "rmsm,lod=area",
                                       "rmsm,lod=axis"};
  const Outcomes o = run(bench, scene, "under", specs, "trees finest", table);
  for (size_t i = 0; i < specs.size(); ++i)
    table.rows.push_back({specs[i], milliseconds(o[i], o[0]), i == 0 ? "-" : whole(counter(o[i], "pages")),
                          megabytes(o[i]), wrong_a_pixel_of_edge(o[i])});
  return table;
}

/// Section 4.4: what the list of requests is made unique from, and what that costs.
BenchTable requests_table(Bench& bench) {
  BenchTable table{
      "Section 4.4: requests, sorted as in the paper or marked as bits",
      "Paper: about 3,000 requests to sort where the wall is seen (under 0.5 ms), 140,000 where the furball "
      "is (30 ms).",
      {"view", "requests", "compacted", "unique", "components to unique", "frame, sort", "frame, bits"},
      {}};
  const Scene scene = make_builtin("furball");
  for (const char* camera : {"wall", "furball"}) {
    const std::string name = fmt::format("furball {}", camera);
    const Outcomes o =
        run(bench, scene, camera, {"sm@2048", "rmsm,requests=sort", "rmsm"}, fmt::format("{} requests", name), table);
    double list = 0;
    for (const compare::StageTime& stage : o[1].result.milliseconds.stages)
      for (const char* of_list : {"connected components", "compaction", "sort", "unique requests"})
        if (stage.name == of_list) list += stage.median;
    table.rows.push_back({name, whole(counter(o[1], "raw_requests")), whole(counter(o[1], "compacted_requests")),
                          whole(counter(o[1], "unique_requests")), fmt::format("{:.0f} ms", list),
                          milliseconds(o[1], o[0]), milliseconds(o[2], o[0])});
  }
  return table;
}

/// Figure 2: a light that grazes what it lights.
BenchTable grazing_table(Bench& bench) {
  BenchTable table{"Figure 2: a grazing light",
                   "Spheres under a sun 6 degrees high: no resolution is enough where light and surface are parallel.",
                   {"spec", "wrong a pixel of edge"},
                   {}};
  Scene scene = make_builtin("spheres");
  scene.lights = {sun(150, 6)};
  const std::vector<std::string> specs{"sm@2048", "rmsm@32768", "rmsm@131072"};
  const Outcomes o = run(bench, scene, "near", specs, "grazing", table);
  for (size_t i = 0; i < specs.size(); ++i) table.rows.push_back({specs[i], wrong_a_pixel_of_edge(o[i])});
  return table;
}

}  // namespace

void bench_rmsm(Bench& bench) {
  views_tables(bench);
  bench.add(scaling_table(bench));
  bench.add(quality_table(bench));
  bench.add(requests_table(bench));
  bench.add(grazing_table(bench));
}

}  // namespace shadewright::app
