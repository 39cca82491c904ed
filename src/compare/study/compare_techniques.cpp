#include <fmt/format.h>

#include <set>

#include "shadewright/compare/path_study.h"
#include "shadewright/compare/study.h"
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

/// A stem a spec, in their order; none is "reference".
std::vector<std::string> file_stems(std::span<const shadow::Spec> specs) {
  std::set<std::string> taken{"reference"};
  std::vector<std::string> stems;
  for (const shadow::Spec& spec : specs) stems.push_back(unique_stem(spec.text, taken));
  return stems;
}

/// Writes the pictures of one view into a folder: of a study (Study or PathStudy) as it stands.
template <typename AnyStudy>
class PictureWriter {
 public:
  PictureWriter(const AnyStudy& study, uint32_t width, uint32_t height, std::filesystem::path folder)
      : study_(study), width_(width), height_(height), folder_(std::move(folder)) {}

  std::string lit(std::span<const float> visibility, std::string name) const {
    return write(render::to_picture(study_.shade(visibility), width_, height_), std::move(name));
  }
  void truth(Report& report) const {
    const std::vector<float> visibility = truth_visibility();
    report.reference_image = lit(visibility, "reference.png");
    report.reference_mask = write(render::to_picture(visibility, width_, height_), "reference-mask.png");
  }
  /// `debug` are the names of the outcome's debug images.
  void technique(const Outcome& outcome, std::span<const std::string> debug, const std::string& stem,
                 TechniqueResult& result) const {
    result.image = lit(outcome.visibility, stem + ".png");
    result.mask = write(render::to_picture(outcome.visibility, width_, height_), stem + "-mask.png");
    result.difference = write(outcome.difference, stem + "-difference.png");
    for (size_t i = 0; i < debug.size(); ++i)
      if (!outcome.debug[i].pixels.empty())
        result.debug.push_back(write(outcome.debug[i], fmt::format("{}-{}.png", stem, file_stem(debug[i]))));
  }
  std::vector<float> truth_visibility() const { return {study_.reference().begin(), study_.reference().end()}; }

 private:
  std::string write(const Picture& picture, std::string name) const {
    write_png(picture, folder_ / name);
    return name;
  }

  const AnyStudy& study_;
  uint32_t width_, height_;
  std::filesystem::path folder_;
};

void write_report(const Report& report, const std::filesystem::path& folder, const Report* before,
                  const Progress& progress) {
  progress("report", 1);
  write_file(folder / "report.json", to_json(report));
  write_file(folder / "report.csv", to_csv(report));
  write_file(folder / "index.html", to_html(report, folder, before));
}

Report write_techniques(Study& study, std::span<const shadow::Spec> specs, const std::filesystem::path& folder,
                        const Report* before, const Progress& progress, std::span<const std::string> debug) {
  Report report = study.report();
  const PictureWriter pictures(study, report.width, report.height, folder);
  pictures.truth(report);
  const std::vector<std::string> stems = file_stems(specs);
  for (size_t i = 0; i < specs.size(); ++i) {
    progress(specs[i].text, static_cast<double>(i) / static_cast<double>(specs.size()));
    Outcome outcome = study.run(specs[i], debug);
    pictures.technique(outcome, debug, stems[i], outcome.result);
    report.results.push_back(std::move(outcome.result));
  }
  write_report(report, folder, before, progress);
  return report;
}

Report write_path(PathStudy& study, std::span<const shadow::Spec> specs, const std::filesystem::path& folder,
                  bool every_frame, const Report* before, const Progress& progress,
                  std::span<const std::string> debug) {
  const std::vector<std::string> stems = file_stems(specs);
  const PictureWriter pictures(study, study.options().width, study.options().height, folder);
  if (every_frame) {
    std::filesystem::create_directory(folder / "reference-frames");
    for (const std::string& stem : stems) std::filesystem::create_directory(folder / (stem + "-frames"));
  }
  Report named;  // holds the pictures' names until there is the report
  named.results.resize(specs.size());
  const auto watch = [&](uint32_t frame, std::span<const Outcome> outcomes) {
    if (every_frame) {
      const std::string name = fmt::format("-frames/{:04}.png", frame);
      pictures.lit(pictures.truth_visibility(), "reference" + name);
      for (size_t i = 0; i < stems.size(); ++i) pictures.lit(outcomes[i].visibility, stems[i] + name);
    }
    if (frame != study.pictured_frame()) return;
    pictures.truth(named);
    for (size_t i = 0; i < stems.size(); ++i) pictures.technique(outcomes[i], debug, stems[i], named.results[i]);
  };
  Report report = study.run(specs, debug, watch, progress);
  report.reference_image = named.reference_image;
  report.reference_mask = named.reference_mask;
  for (size_t i = 0; i < stems.size(); ++i) {
    report.results[i].image = named.results[i].image;
    report.results[i].mask = named.results[i].mask;
    report.results[i].difference = named.results[i].difference;
    report.results[i].debug = named.results[i].debug;
  }
  write_report(report, folder, before, progress);
  return report;
}

}  // namespace

Report compare_techniques(Study& study, std::span<const shadow::Spec> specs, const std::filesystem::path& folder,
                          const Report* before, const Progress& progress, std::span<const std::string> debug) {
  Report report;
  write_folder(folder, [&](const std::filesystem::path& temporary) {
    report = write_techniques(study, specs, temporary, before, progress, debug);
  });
  return report;
}

Report compare_along_path(PathStudy& study, std::span<const shadow::Spec> specs, const std::filesystem::path& folder,
                          bool every_frame, const Report* before, const Progress& progress,
                          std::span<const std::string> debug) {
  Report report;
  write_folder(folder, [&](const std::filesystem::path& temporary) {
    report = write_path(study, specs, temporary, every_frame, before, progress, debug);
  });
  return report;
}

}  // namespace shadewright::compare
