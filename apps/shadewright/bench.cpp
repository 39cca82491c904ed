#include "bench.h"

#include "shadewright/files.h"
#include "shadewright/render/image.h"

namespace shadewright::app {

const gpu::Device& Bench::device() {
  if (!device_) device_ = std::make_unique<gpu::Device>(options_.device);
  return *device_;
}

std::string Bench::shown(const std::string& spec) const {
  const std::string folder = (options_.folder / "").string();
  const size_t at = spec.find(folder);
  return at == std::string::npos ? spec : spec.substr(0, at) + spec.substr(at + folder.size());
}

compare::Study Bench::study(const Scene& scene, const Camera& camera, const Light& light,
                            std::optional<uint32_t> size) {
  progress(scene.name + ", " + camera.name, 0);
  return compare::Study(device(), scene, camera, light,
                        {size.value_or(options_.width), size.value_or(options_.height), options_.repeat, 16, true});
}

std::vector<compare::Outcome> Bench::run(compare::Study& study, const std::vector<std::string>& specs,
                                         const std::string& stem, BenchTable& table) {
  const compare::Report& report = study.report();
  const auto picture = [&](std::span<const float> visibility, const std::string& name) {
    const std::string file = file_stem(stem + "-" + name) + ".png";
    write_png(render::to_picture(study.shade(visibility), report.width, report.height), options_.folder / file);
    table.pictures.push_back({name, file});
  };
  picture(std::vector<float>(study.reference().begin(), study.reference().end()), "reference");
  std::vector<compare::Outcome> outcomes;
  for (const std::string& spec : specs) {
    progress(stem + ", " + shown(spec), static_cast<double>(outcomes.size()) / static_cast<double>(specs.size()));
    outcomes.push_back(study.run(shadow::parse_spec(spec)));
    picture(outcomes.back().visibility, shown(spec));
  }
  return outcomes;
}

}  // namespace shadewright::app
