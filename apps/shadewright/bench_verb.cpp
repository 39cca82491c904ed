// shadewright bench: the papers' tables, their figures beside ours.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "bench_cpvs.h"
#include "interrupt.h"
#include "progress_bar.h"
#include "shadewright/error.h"
#include "shadewright/files.h"
#include "verbs.h"

namespace shadewright::app {

namespace {

struct Flags {
  std::vector<std::string> papers;
  std::string output;
  CpvsBench cpvs;
  bool quiet = false;
};

void run(const Flags& flags) {
  for (const std::string& paper : flags.papers) {
    if (paper == "cpvs") continue;
    if (paper == "psm" || paper == "rmsm" || paper == "rtw" || paper == "spsm")
      throw InputError("bench " + paper, "this paper's tables are not built yet", "bench cpvs is");
    throw InputError("bench " + paper, "there is no such paper", "choose among psm, rmsm, rtw, cpvs, spsm");
  }
  std::error_code error;
  std::filesystem::create_directories(flags.output, error);
  if (error)
    throw FailureError(flags.output, "can't be made (" + error.message() + ")", "choose another place with -o");
  ProgressBar bar(flags.quiet);
  const std::vector<BenchTable> tables = bench_cpvs(flags.cpvs, interruptible(bar.callback()));
  const std::filesystem::path folder(flags.output);
  const std::string markdown = to_markdown(tables);
  write_file(folder / "cpvs.json", to_json(tables).dump(2) + "\n");
  write_file(folder / "cpvs.md", markdown);
  bar.clear();
  if (!flags.quiet) fmt::print("{}", markdown);
}

}  // namespace

void add_bench(CLI::App& app) {
  auto flags = std::make_shared<Flags>();
  CLI::App* verb = app.add_subcommand("bench", "The papers' tables, their figures beside ours");
  verb->add_option("PAPER", flags->papers, "psm, rmsm, rtw, cpvs or spsm; none = all that are built");
  verb->add_option("-o,--output", flags->output, "Folder for the tables (Markdown and JSON)")->required();
  verb->add_option("--limit", flags->cpvs.limit, "cpvs: largest resolution to bake")
      ->capture_default_str()
      ->check(CLI::IsMember({1024, 4096, 16384, 32768, 65536, 131072, 262144, 1048576}));
  verb->add_option("--check", flags->cpvs.check_voxels, "cpvs: random voxels to compare with exact depths, a scene")
      ->capture_default_str();
  verb->add_flag("--quiet", flags->quiet, "No progress, no tables on standard output");
  verb->footer("Example: shadewright bench cpvs -o out/bench");
  verb->callback([flags] { run(*flags); });
}

}  // namespace shadewright::app
