#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <system_error>

#include "shadewright/compare/study.h"
#include "shadewright/error.h"
#include "shadewright/files.h"

namespace shadewright::compare {

namespace {

/// A file name for a spec: letters, digits, dots and dashes.
std::string file_stem(std::string_view spec, std::set<std::string>& taken) {
  std::string stem;
  for (const char c : spec) stem += std::isalnum(static_cast<unsigned char>(c)) || c == '.' ? c : '-';
  std::string unique = stem;
  for (int i = 2; !taken.insert(unique).second; ++i) unique = fmt::format("{}-{}", stem, i);
  return unique;
}

}  // namespace

render::Picture difference_picture(const Study& study, std::span<const float> visibility) {
  const auto reference = study.reference();
  const std::vector<float> truth(reference.begin(), reference.end());
  render::Picture picture = render::to_picture(study.shade(truth), study.report().width, study.report().height);
  for (size_t i = 0; i < truth.size(); ++i) {
    uint8_t* pixel = &picture.data[3 * i];
    const auto grey = static_cast<uint8_t>(0.5 * (0.30 * pixel[0] + 0.59 * pixel[1] + 0.11 * pixel[2]) + 64);
    const bool lit = visibility[i] >= 0.5f, lit_in_truth = truth[i] >= 0.5f;
    const bool compared = study.points()[i].valid();
    const uint8_t red[3] = {230, 40, 30}, blue[3] = {40, 90, 240}, neutral[3] = {grey, grey, grey};
    std::copy_n(!compared || lit == lit_in_truth ? neutral : lit_in_truth ? red : blue, 3, pixel);
  }
  return picture;
}

Report compare_techniques(Study& study, std::span<const shadow::Spec> specs, const std::filesystem::path& folder, const Report* before,
                          const Progress& progress) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw FailureError(folder.string(), "can't be made (" + error.message() + ")", "choose another place with -o");
  Report report = study.report();
  const auto write = [&](const render::Picture& picture, std::string name) {
    render::write_png(picture, folder / name);
    return name;
  };
  const std::vector<float> truth(study.reference().begin(), study.reference().end());
  report.reference_image = write(render::to_picture(study.shade(truth), report.width, report.height), "reference.png");
  report.reference_mask = write(render::to_picture(truth, report.width, report.height), "reference-mask.png");

  std::set<std::string> stems{"reference"};
  for (size_t i = 0; i < specs.size(); ++i) {
    progress(specs[i].text, static_cast<double>(i) / static_cast<double>(specs.size()));
    Outcome outcome = study.run(specs[i]);
    const std::string stem = file_stem(specs[i].text, stems);
    outcome.result.image = write(render::to_picture(study.shade(outcome.visibility), report.width, report.height), stem + ".png");
    outcome.result.mask = write(render::to_picture(outcome.visibility, report.width, report.height), stem + "-mask.png");
    outcome.result.difference = write(difference_picture(study, outcome.visibility), stem + "-difference.png");
    report.results.push_back(std::move(outcome.result));
  }
  progress("report", 1);
  write_file(folder / "report.json", to_json(report));
  write_file(folder / "report.csv", to_csv(report));
  write_file(folder / "index.html", to_html(report, folder, before));
  return report;
}

}  // namespace shadewright::compare
