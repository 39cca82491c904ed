// What the benches of all papers share: options, the device, and runs of several techniques on one view.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench_table.h"
#include "shadewright/compare/study.h"
#include "shadewright/progress.h"

namespace shadewright::app {

struct BenchOptions {
  std::filesystem::path folder;          ///< for tables and pictures
  uint32_t width = 1024, height = 1024;  ///< of images, where the paper does not say
  uint32_t repeat = 5;
  gpu::DeviceOptions device;
  uint32_t limit = 65536;              ///< cpvs: largest resolution to bake
  uint64_t check_voxels = 10'000'000;  ///< cpvs: random voxels to compare with exact depths, a scene
};

/// A bench under way.
class Bench {
 public:
  /// `done` takes each table as soon as it is made.
  Bench(BenchOptions options, Progress progress, std::function<void(BenchTable)> done)
      : options_(std::move(options)), progress_(std::move(progress)), done_(std::move(done)) {}

  const BenchOptions& options() const { return options_; }
  void progress(const std::string& what, double share) const { progress_(what, share); }
  const Progress& progress() const { return progress_; }
  void add(BenchTable table) const { done_(std::move(table)); }
  /// Found at the first call: what needs no device runs without one.
  const gpu::Device& device();

  /// A spec as tables name it: without the folder of its files.
  std::string shown(const std::string& spec) const;

  /// A study of one view, with the options' repeats and size, or square of `size` pixels.
  compare::Study study(const Scene& scene, const Camera& camera, const Light& light, std::optional<uint32_t> size = {});
  /// Runs `specs` in `study`, one outcome each. Pictures of the reference and of each are written as
  /// STEM-reference.png and STEM-SPEC.png, and named in `table`.
  std::vector<compare::Outcome> run(compare::Study& study, const std::vector<std::string>& specs,
                                    const std::string& stem, BenchTable& table);

 private:
  BenchOptions options_;
  Progress progress_;
  std::function<void(BenchTable)> done_;
  std::unique_ptr<gpu::Device> device_;
};

void bench_cpvs(Bench& bench);
void bench_psm(Bench& bench);
void bench_rmsm(Bench& bench);
void bench_spsm(Bench& bench);
void bench_rtw(Bench& bench);

}  // namespace shadewright::app
