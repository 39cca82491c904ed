// The tables of "Resolution-Matched Shadow Maps" (2007), the paper's figures beside ours. Ratios to the standard shadow
// map are what compares: the paper's frames are a GeForce 7800 GTX's. Levels are chosen by lod=bounded unless a table
// says otherwise, which asks for more pages than the paper's equation 1.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "bench.h"
#include "shadewright/files.h"
#include "shadewright/image/picture.h"
#include "shadewright/scene/builtin.h"

namespace shadewright::app {

namespace {

using Outcomes = std::vector<compare::Outcome>;

/// A view that stands for one of the paper's, and the paper's figures of it (iterative, resolution-matched).
struct PaperView {
  const char *name, *scene, *camera;
  const char *superpages_iterative, *superpages_rmsm;  ///< figure 11(a)
  const char *pages_iterative, *pages_rmsm;            ///< figure 12(a)
};
const std::vector<PaperView> views = {
    {"robot", "characters", "near", "35-61", "31-32", "737-2467", "3294-4666"},
    {"skeletons", "characters", "main", "30-63", "35-64", "1300-2200", "2900-5600"},
    {"trees", "trees", "wide", "40-104", "32-77", "2300-5500", "3800-5900"},
    {"city", "city?triangles=58000", "street", "53-154", "59-149", "1300-2900", "3800-7100"},
    {"furball-W", "furball", "wall", "45-155", "35-39", "1300-5000", "4800-5900"},
    {"furball-F", "furball", "furball", "45-155", "35-39", "1300-5000", "4800-5900"}};

/// Figure 8, by view: frames a second of A/I/C, A/N/C, A/I/G, A/N/G (adaptive, iterative or not, analysed on CPU or
/// GPU). A standard map's are 80-100 in every row.
using PaperVariants = std::array<const char*, 4>;
const std::vector<PaperVariants> static_frames = {
    {"6-7", "0.1-1", "11-15", "30-32"}, {"7-9", "0.5-1", "16-20", "34-38"}, {"8-9", "0.5-1", "12-18", "30-35"},
    {"6-8", "0.5-1", "11-13", "20-25"}, {"8-9", "0.5-1", "20-30", "30-35"}, {"5-6", "0.5-1", "7-10", "15-17"}};
const std::vector<PaperVariants> dynamic_frames = {{"3-4", "0.5-1", "4-7", "13-24"}, {"5-7", "0.5-1", "7-8", "16-20"},
                                                   {"3-4", "0.5-1", "6-7", "13-14"}, {"2-3", "0.5-1", "6-8", "16-28"},
                                                   {"1-2", "0.5-1", "2-3", "20-25"}, {"0.5-1", "0.5-1", "4-5", "6-7"}};

double counter(const compare::Outcome& outcome, const char* name) {
  return outcome.result.counters.at(name).front();
}

std::string milliseconds(const compare::Outcome& outcome, const compare::Outcome& sm) {
  const double frame = outcome.result.frame_milliseconds;
  return fmt::format("{:.0f} ms ({:.2f}x)", frame, frame / sm.result.frame_milliseconds);
}

/// The milliseconds of some stages.
double stages(const compare::Outcome& outcome, std::initializer_list<std::string_view> names) {
  double sum = 0;
  for (const compare::StageTime& stage : outcome.result.milliseconds.stages)
    if (std::find(names.begin(), names.end(), stage.name) != names.end()) sum += stage.median;
  return sum;
}

/// What drawing the pages takes, whichever way.
double drawing(const compare::Outcome& outcome) {
  return stages(outcome,
                {"pages to the host", "superpages", "superpage views", "shadow cull", "page triangles", "shadow map"});
}

std::string with_paper(const std::string& ours, const char* paper) {
  return fmt::format("{} [{}]", ours, paper);
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

/// Figures 8, 11(a), 12(a) and 13 from the same runs.
void views_tables(Bench& bench) {
  const std::vector<std::string> columns{"view", "sm@2048", "A/I/C", "A/N/C", "A/I/G", "A/N/G", "A/I/G : A/N/G"};
  BenchTable kept{
      "Figure 8, static: frames of standard and adaptive maps whose pages are kept",
      "Whole frames in milliseconds and as ratios to the 2048 standard map of the same run; in brackets the paper's "
      "frames a second (its standard map: 80-100 in every row). Iterative (asm) or not (rmsm), analysis on the CPU "
      "(analysis=cpu: each pixel's requests are read back and made unique by the host) or the GPU; cache=on, "
      "lod=bounded.",
      columns,
      {}};
  BenchTable dynamic{"Figure 8, dynamic: frames whose pages are all drawn",
                     "As above, with cache=off. Pages are drawn straight into the pool in all variants.",
                     columns,
                     {}};
  BenchTable superpages{
      "Figure 11(a): superpages, and what they cost against drawing pages straight into the pool",
      "Superpages of 1,024^2 drawn in a dynamic frame (draw=superpages), the paper's in brackets, and pages for each "
      "(paper: 50 to 150). Drawing: milliseconds from the pages to draw to the filled pool, all superpages against one "
      "pass (draw=pages). The last column is algorithm 2 as written (requests=sort,draw=superpages). lod=bounded asks "
      "for more pages than the paper.",
      {"view", "superpages ASM", "superpages RMSM", "pages a superpage", "drawing ASM, superpages",
       "drawing ASM, pages", "drawing RMSM, superpages", "drawing RMSM, pages", "frame RMSM, superpages",
       "frame RMSM, pages", "frame, algorithm 2"},
      {}};
  BenchTable memory{"Figure 12(a): pages",
                    "Pages of 32 x 32 texels that a frame draws from nothing; lod=bounded.",
                    {"view", "ASM", "paper", "RMSM", "paper"},
                    {}};
  BenchTable use{
      "Figure 13: how much of the pages is used",
      "The share of the drawn texels that the look-up reads. Paper: 50 to 70 % for coherent receivers, 10 to 30 % "
      "for hair and leaves; about half on average.",
      {"view", "used texels", "taps", "by a coarser page", "unserved"},
      {}};
  BenchTable errors{"Errors (not in the paper)",
                    "Wrong pixels for each pixel of true shadow edge; lod=bounded.",
                    {"view", "sm@2048", "ASM", "RMSM", "RMSM, one texel", "oracle fraction"},
                    {}};
  for (size_t v = 0; v < views.size(); ++v) {
    const PaperView& view = views[v];
    const Scene scene = make_builtin(view.scene);
    const std::vector<std::string> specs{"sm@2048",
                                         "asm,analysis=cpu,cache=on",
                                         "rmsm,analysis=cpu,cache=on",
                                         "asm,cache=on",
                                         "rmsm,cache=on",
                                         "asm,analysis=cpu",
                                         "rmsm,analysis=cpu",
                                         "asm",
                                         "rmsm",
                                         "asm,draw=superpages",
                                         "rmsm,draw=superpages",
                                         "rmsm,requests=sort,draw=superpages",
                                         "rmsm,statistics=on",
                                         "paged/depth/hard"};
    const Outcomes o = run(bench, scene, view.camera, specs, view.name, kept);
    const auto variants = [&](size_t first, const PaperVariants& paper) {
      std::vector<std::string> cells{view.name, with_paper(milliseconds(o[0], o[0]), "80-100")};
      for (size_t i = 0; i < paper.size(); ++i) cells.push_back(with_paper(milliseconds(o[first + i], o[0]), paper[i]));
      cells.push_back(
          fmt::format("{:.2f}", o[first + 2].result.frame_milliseconds / o[first + 3].result.frame_milliseconds));
      return cells;
    };
    kept.rows.push_back(variants(1, static_frames[v]));
    dynamic.rows.push_back(variants(5, dynamic_frames[v]));
    const compare::Outcome &iterative = o[7], &rmsm = o[8], &iterative_superpages = o[9], &rmsm_superpages = o[10];
    superpages.rows.push_back(
        {view.name, with_paper(whole(counter(iterative_superpages, "superpages")), view.superpages_iterative),
         with_paper(whole(counter(rmsm_superpages, "superpages")), view.superpages_rmsm),
         whole(counter(rmsm_superpages, "pages_drawn") / counter(rmsm_superpages, "superpages")),
         fmt::format("{:.0f} ms", drawing(iterative_superpages)), fmt::format("{:.0f} ms", drawing(iterative)),
         fmt::format("{:.0f} ms", drawing(rmsm_superpages)), fmt::format("{:.0f} ms", drawing(rmsm)),
         milliseconds(rmsm_superpages, o[0]), milliseconds(rmsm, o[0]), milliseconds(o[11], o[0])});
    memory.rows.push_back({view.name, whole(counter(iterative, "pages")), view.pages_iterative,
                           whole(counter(rmsm, "pages")), view.pages_rmsm});
    use.rows.push_back({view.name, fmt::format("{:.0f} %", 100 * counter(o[12], "page_utilization")),
                        whole(counter(o[12], "taps")), whole(counter(o[12], "coarser_taps")),
                        whole(counter(o[12], "unserved_taps"))});
    errors.rows.push_back({view.name, wrong_a_pixel_of_edge(o[0]), wrong_a_pixel_of_edge(iterative),
                           wrong_a_pixel_of_edge(rmsm), wrong_a_pixel_of_edge(o[13]),
                           fmt::format("{:.5f}", o[13].result.error.oracle_fraction.value_or(0))});
  }
  for (BenchTable* table : {&kept, &dynamic, &superpages, &memory, &use, &errors}) bench.add(std::move(*table));
}

/// Figure 14: the page tables of two views.
BenchTable use_table(Bench& bench) {
  BenchTable table{"Figures 4 and 14: pages in the image, and use per page",
                   "pages: each pixel in the colour of its level. page-use: a pixel a page, level 0 to the left, "
                   "coarser ones beside "
                   "it; green: not asked for; black to white: the share of its texels that the look-up reads.",
                   {"view", "pages", "used texels"},
                   {}};
  const Scene scene = make_builtin("furball");
  for (const char* camera : {"wall", "furball"}) {
    compare::Study study = bench.study(scene, find_camera(scene, camera), scene.lights.front());
    // Superpages copy what was asked for and nothing else.
    for (const std::string spec : {"rmsm,draw=superpages,statistics=on", "asm,draw=superpages,statistics=on"}) {
      const std::vector<std::string> names{"pages", "page-use"};
      const compare::Outcome o = study.run(shadow::parse_spec(spec), names);
      const std::string name = fmt::format("furball {} {}", camera, spec.substr(0, spec.find(',')));
      for (size_t i = 0; i < names.size(); ++i) {
        const std::string file = file_stem(name + "-" + names[i]) + ".png";
        write_png(o.debug[i], bench.options().folder / file);
        table.pictures.push_back({fmt::format("{}, {}", name, names[i]), file});
      }
      table.rows.push_back(
          {name, whole(counter(o, "pages")), fmt::format("{:.0f} %", 100 * counter(o, "page_utilization"))});
    }
  }
  return table;
}

/// Figures 9, 10, 11(b) and 12(b): image sizes, and three views of trees.
BenchTable scaling_table(Bench& bench) {
  BenchTable table{"Figures 9, 10, 11(b) and 12(b): image sizes, and three views of trees",
                   "Dynamic frames, lod=bounded. In brackets the paper's pages and superpages.",
                   {"view", "image", "sm@2048", "A/I/C", "A/N/C", "A/I/G", "A/N/G", "pages ASM", "pages RMSM",
                    "superpages ASM", "superpages RMSM"},
                   {}};
  struct Row {
    const char *scene, *camera;
    uint32_t size;
    const char *pages_iterative, *pages_rmsm, *superpages_iterative, *superpages_rmsm;
  };
  for (const Row& row :
       {Row{"furball", "wall", 512, "539", "1376", "79", "15"},
        Row{"furball", "furball", 512, "3506", "3948", "42", "34"},
        Row{"furball", "wall", 1024, "1446", "4886", "155", "35"},
        Row{"furball", "furball", 1024, "5056", "5472", "49", "36"}, Row{"trees", "wide", 1024, "-", "-", "-", "-"},
        Row{"trees", "under", 1024, "-", "-", "-", "-"}, Row{"trees", "crown", 1024, "-", "-", "-", "-"}}) {
    const Scene scene = make_builtin(row.scene);
    const std::string name = fmt::format("{} {}", row.scene, row.camera);
    const Outcomes o = run(bench, scene, row.camera,
                           {"sm@2048", "asm,analysis=cpu", "rmsm,analysis=cpu", "asm", "rmsm", "asm,draw=superpages",
                            "rmsm,draw=superpages"},
                           fmt::format("{} {}", name, row.size), table, row.size);
    std::vector<std::string> cells{name, fmt::format("{}^2", row.size)};
    for (size_t i = 0; i < 5; ++i) cells.push_back(milliseconds(o[i], o[0]));
    cells.push_back(with_paper(whole(counter(o[3], "pages")), row.pages_iterative));
    cells.push_back(with_paper(whole(counter(o[4], "pages")), row.pages_rmsm));
    cells.push_back(with_paper(whole(counter(o[5], "superpages")), row.superpages_iterative));
    cells.push_back(with_paper(whole(counter(o[6], "superpages")), row.superpages_rmsm));
    table.rows.push_back(std::move(cells));
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
      {"view", "requests", "compacted", "unique", "components to unique", "sort alone", "frame, sort", "frame, bits"},
      {}};
  const Scene scene = make_builtin("furball");
  for (const char* camera : {"wall", "furball"}) {
    const std::string name = fmt::format("furball {}", camera);
    const Outcomes o =
        run(bench, scene, camera, {"sm@2048", "rmsm,requests=sort", "rmsm"}, fmt::format("{} requests", name), table);
    const double list = stages(o[1], {"connected components", "compaction", "sort", "unique requests"});
    table.rows.push_back({name, whole(counter(o[1], "raw_requests")), whole(counter(o[1], "compacted_requests")),
                          whole(counter(o[1], "unique_requests")), fmt::format("{:.0f} ms", list),
                          fmt::format("{:.0f} ms", stages(o[1], {"sort"})), milliseconds(o[1], o[0]),
                          milliseconds(o[2], o[0])});
  }
  return table;
}

/// Section 3.2: what each step that thins the list of requests brings, refined or not.
BenchTable uniquify_table(Bench& bench) {
  BenchTable table{
      "Section 3.2: thinning the list of requests",
      "Frames a second in the paper (robot), where the host gets what is left of the list: as here with analysis=cpu "
      "(host: its reading and its work). With analysis=gpu the device marks the pages of the list, and thinning it "
      "only "
      "costs. ASM's lengths are sums over its rounds. Paper, furball: the last step makes the frame up to 2 times "
      "faster.",
      {"view", "spec", "step", "paper", "list", "host", "frame, analysis=cpu", "frame, analysis=gpu"},
      {}};
  struct Step {
    const char *uniquify, *meaning, *rmsm, *iterative;
  };
  const std::vector<Step> steps{{"none", "as it is", "0.5-1", "4"},
                                {"components", "connected components", "10", "5"},
                                {"compact", "compaction too", "15", "7"},
                                {"full", "sort and compaction too", "17", "7"}};
  for (const auto& [name, builtin, camera] :
       {std::array{"robot", "characters", "near"}, std::array{"furball-F", "furball", "furball"}}) {
    const Scene scene = make_builtin(builtin);
    const bool robot = std::string_view(name) == "robot";
    for (const std::string spec : {"rmsm", "asm"}) {
      std::vector<std::string> specs{"sm@2048"};
      for (const Step& step : steps)
        for (const char* analysis : {"cpu", "gpu"})
          specs.push_back(fmt::format("{},uniquify={},analysis={}", spec, step.uniquify, analysis));
      const Outcomes o = run(bench, scene, camera, specs, fmt::format("{} {} uniquify", name, spec), table);
      for (size_t i = 0; i < steps.size(); ++i) {
        const compare::Outcome &on_host = o[1 + 2 * i], &on_device = o[2 + 2 * i];
        const char* paper = spec == "rmsm" ? steps[i].rmsm : steps[i].iterative;
        table.rows.push_back(
            {name, spec, steps[i].meaning, robot ? paper : "-", whole(counter(on_host, "listed_requests")),
             fmt::format("{:.0f} ms", stages(on_host, {"requests to the host", "requests on the host"})),
             milliseconds(on_host, o[0]), milliseconds(on_device, o[0])});
      }
    }
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
  bench.add(use_table(bench));
  bench.add(scaling_table(bench));
  bench.add(quality_table(bench));
  bench.add(requests_table(bench));
  bench.add(uniquify_table(bench));
  bench.add(grazing_table(bench));
}

}  // namespace shadewright::app
