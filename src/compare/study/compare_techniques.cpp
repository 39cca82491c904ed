#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "shadewright/compare/study.h"
#include "shadewright/error.h"
#include "shadewright/files.h"

namespace shadewright::compare {

namespace {

/// A file name for a spec that no other spec has.
std::string unique_stem(std::string_view spec, std::set<std::string>& taken) {
  const std::string stem = file_stem(spec);
  std::string unique = stem;
  for (int i = 2; !taken.insert(unique).second; ++i) unique = fmt::format("{}-{}", stem, i);
  return unique;
}

}  // namespace

Report compare_techniques(Study& study, std::span<const shadow::Spec> specs, const std::filesystem::path& folder,
                          const Report* before, const Progress& progress) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw FailureError(folder.string(), "can't be made (" + error.message() + ")", "choose another place with -o");
  Report report = study.report();
  const auto write = [&](const Picture& picture, std::string name) {
    write_png(picture, folder / name);
    return name;
  };
  const std::vector<float> truth(study.reference().begin(), study.reference().end());
  report.reference_image = write(render::to_picture(study.shade(truth), report.width, report.height), "reference.png");
  report.reference_mask = write(render::to_picture(truth, report.width, report.height), "reference-mask.png");

  std::set<std::string> stems{"reference"};
  for (size_t i = 0; i < specs.size(); ++i) {
    progress(specs[i].text, static_cast<double>(i) / static_cast<double>(specs.size()));
    Outcome outcome = study.run(specs[i]);
    const std::string stem = unique_stem(specs[i].text, stems);
    outcome.result.image =
        write(render::to_picture(study.shade(outcome.visibility), report.width, report.height), stem + ".png");
    outcome.result.mask =
        write(render::to_picture(outcome.visibility, report.width, report.height), stem + "-mask.png");
    outcome.result.difference = write(outcome.difference, stem + "-difference.png");
    report.results.push_back(std::move(outcome.result));
  }
  progress("report", 1);
  write_file(folder / "report.json", to_json(report));
  write_file(folder / "report.csv", to_csv(report));
  write_file(folder / "index.html", to_html(report, folder, before));
  return report;
}

}  // namespace shadewright::compare
