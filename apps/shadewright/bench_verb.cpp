// shadewright bench: the papers' tables, their figures beside ours.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

#include "bench.h"
#include "interrupt.h"
#include "options.h"
#include "progress_bar.h"
#include "shadewright/error.h"
#include "shadewright/files.h"
#include "verbs.h"

namespace shadewright::app {

namespace {

struct Paper {
  const char* name;
  void (*run)(Bench&);
};
constexpr Paper papers[] = {
    {"psm", bench_psm}, {"rmsm", bench_rmsm}, {"rtw", bench_rtw}, {"cpvs", bench_cpvs}, {"spsm", bench_spsm}};

struct Flags {
  std::vector<std::string> papers;
  std::string size;
  BenchOptions options;
  bool quiet = false;
};

const Paper& find_paper(const std::string& name) {
  const auto* paper =
      std::find_if(std::begin(papers), std::end(papers), [&](const Paper& p) { return p.name == name; });
  if (paper == std::end(papers))
    throw InputError("bench " + name, "there is no such paper", "choose among psm, rmsm, rtw, cpvs, spsm");
  return *paper;
}

void run(const Flags& flags) {
  std::vector<const Paper*> chosen;
  for (const std::string& name : flags.papers) chosen.push_back(&find_paper(name));
  if (chosen.empty())
    for (const Paper& paper : papers) chosen.push_back(&paper);
  BenchOptions options = flags.options;
  if (!flags.size.empty()) parse_size(flags.size, options.width, options.height);
  std::error_code error;
  std::filesystem::create_directories(options.folder, error);
  if (error)
    throw FailureError(options.folder.string(), "can't be made (" + error.message() + ")",
                       "choose another place with -o");
  ProgressBar bar(flags.quiet);
  for (const Paper* paper : chosen) {
    // Written after every table: benches take long, and an interrupted one keeps what it has.
    std::vector<BenchTable> tables;
    Bench bench(options, interruptible(bar.callback()), [&](BenchTable table) {
      bar.clear();
      if (!flags.quiet) fmt::print("{}", to_markdown({table}));
      tables.push_back(std::move(table));
      const std::string name = paper->name;
      write_file(options.folder / (name + ".json"), to_json(tables).dump(2) + "\n");
      write_file(options.folder / (name + ".md"), to_markdown(tables));
    });
    try {
      paper->run(bench);
    } catch (const Interrupted&) {
      throw Interrupted{"finished tables are in " + options.folder.string()};
    }
  }
}

}  // namespace

void add_bench(CLI::App& app) {
  auto flags = std::make_shared<Flags>();
  BenchOptions& options = flags->options;
  CLI::App* verb = app.add_subcommand("bench", "The papers' tables, their figures beside ours");
  verb->add_option("PAPER", flags->papers, "psm, rmsm, rtw, cpvs or spsm; none = all that are built");
  verb->add_option("-o,--output", options.folder, "Folder for the tables (Markdown, JSON) and their pictures")
      ->required();
  verb->add_option("--size", flags->size, "Image size WxH in pixels, where the paper's tables do not say");
  verb->add_option("--repeat", options.repeat, "Timed repeats after warm-up")
      ->capture_default_str()
      ->check(CLI::Range(0, 10000));
  verb->add_option("--device", options.device.select, "Device by index or part of its name");
  verb->add_option("--limit", options.limit, "cpvs: largest resolution to bake")
      ->capture_default_str()
      ->check(CLI::IsMember({1024, 4096, 16384, 32768, 65536, 131072, 262144, 1048576}));
  verb->add_option("--check", options.check_voxels, "cpvs: random voxels to compare with exact depths, a scene")
      ->capture_default_str();
  verb->add_flag("--quiet", flags->quiet, "No progress, no tables on standard output");
  verb->footer("Example: shadewright bench cpvs -o out/bench");
  verb->callback([flags] { run(*flags); });
}

}  // namespace shadewright::app
