// Perspective against uniform maps on random cameras and lights (techniques.md, section 2): the ratio of wrong pixels,
// and the oracle. Usage: psm_random_pairs [SCENE] [PAIRS] [SEED] [SPEC] [RESOLUTION] [WIDTHxHEIGHT] [PAIR FOLDER];
// PAIRS 0 = the scene's own cameras and first light. With a PAIR's number only that one is run, and FOLDER gets its
// pictures: the truth with false shadow in red and false light in blue.
//
// Random cameras also stand inside closed bodies, most often in the ground. They see bodies' inner sides only, whose
// shadows are those of seams: that nothing breaks there counts, how many pixels differ says nothing about a view that
// anybody renders. So ratios are told of all pairs and of those whose camera stands in free space.
//
// Few edges and few texels make a ratio a matter of where texels happen to lie. How much so tells a second uniform map
// of two texels less, which should be as good as the first.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "compare/study/pair_errors_for_test.h"
#include "shadewright/scene/load.h"
#include "shadow/parameterization/perspective/random_pairs_for_test.h"

using namespace shadewright;

namespace {

/// Who stands inside sees more of inner sides than this; rays slip through the seams of bodies that touch.
constexpr double inside_share = 0.01;

/// One pixel more each, so that a view without an error counts as one.
double ratio_of(uint64_t wrong, uint64_t uniform) {
  return (static_cast<double>(wrong) + 1) / (static_cast<double>(uniform) + 1);
}

/// Wrong pixels against the uniform map's over pairs.
struct Ratios {
  std::vector<double> ratios;
  uint64_t wrong_uniform = 0, wrong = 0;

  void add(uint64_t one, uint64_t uniform) {
    ratios.push_back(ratio_of(one, uniform));
    wrong_uniform += uniform;
    wrong += one;
  }
  void print(const char* name) {
    if (ratios.empty()) return;
    std::sort(ratios.begin(), ratios.end());
    double log_sum = 0;
    for (const double ratio : ratios) log_sum += std::log(ratio);
    const size_t count = ratios.size();
    fmt::print(
        "{}: {} pairs, wrong {} -> {}, ratio geometric mean {:.3f}, median {:.3f}, 95th percentile {:.3f}, worst "
        "{:.2f}\n",
        name, count, wrong_uniform, wrong, std::exp(log_sum / static_cast<double>(count)), ratios[count / 2],
        ratios[count * 95 / 100], ratios.back());
  }
};

}  // namespace

int main(int argc, char** argv) {
  const auto argument = [&](int i, const char* standard) { return std::string(argc > i ? argv[i] : standard); };
  const int pairs = std::stoi(argument(2, "1000"));
  const auto seed = static_cast<unsigned>(std::stoul(argument(3, "2002")));
  const std::string resolution = argument(5, "256"), size = argument(6, "160x120");
  const auto width = static_cast<uint32_t>(std::stoul(size)),
             height = static_cast<uint32_t>(std::stoul(size.substr(size.find('x') + 1)));
  const Scene scene = load_scene(argument(1, "builtin:sandbox")).scene;
  const gpu::Device device{gpu::DeviceOptions{}};
  std::string spec = argument(4, "psm");
  spec.insert(std::min(spec.find(','), spec.size()), "@" + resolution);
  const std::string other_texels = fmt::format("sm@{}", std::stoi(resolution) - 2);
  const std::vector<std::string> specs{"sm@" + resolution, spec, other_texels};
  compare::PairErrors errors(device, scene, width, height, specs);
  shadow::RandomPairs random(bounds(scene), seed);
  Ratios all, free_space, chance;
  double worst_oracle = 0;
  uint64_t oracle_wrong = 0, beyond_snapping = 0, compared_total = 0;
  int bad_oracles = 0, fallbacks = 0;
  fmt::print("seed {}\n", seed);
  const int only = std::stoi(argument(7, "-1"));
  const int own = static_cast<int>(scene.cameras.size());
  for (int i = 0; i < (pairs > 0 ? pairs : own); ++i) {
    auto [camera, light] = random.next();
    if (pairs == 0) {
      camera = scene.cameras[static_cast<size_t>(i)];
      camera.near = near_distance(scene, camera);
      light = scene.lights.front();
    }
    if (only >= 0 && i != only) continue;
    const auto results = errors.run(camera, light);
    if (only >= 0)
      for (size_t technique = 0; technique < results.size(); ++technique)
        write_png(results[technique].picture,
                  std::filesystem::path(argument(8, ".")) / fmt::format("{}_{}.png", i, specs[technique]));
    const auto &uniform = results[0].error, &perspective = results[1].error;
    if (perspective.compared < width * height / 50) continue;
    const double oracle = perspective.oracle_fraction.value_or(1);
    const double inner = errors.inner_share(camera);
    all.add(perspective.wrong, uniform.wrong);
    if (inner < inside_share) {
      free_space.add(perspective.wrong, uniform.wrong);
      chance.add(results[2].error.wrong, uniform.wrong);
    }
    compared_total += perspective.compared;
    beyond_snapping += results[1].beyond_snapping;
    oracle_wrong += static_cast<uint64_t>(std::lround(oracle * static_cast<double>(perspective.compared)));
    worst_oracle = std::max(worst_oracle, oracle);
    // Half a pixel's allowance: one pixel of a small image is more than 0.0005.
    bad_oracles += oracle * static_cast<double>(perspective.compared) >
                   std::max(1.5, 5e-4 * static_cast<double>(perspective.compared));
    fallbacks += results[1].counters.at("fallback").front() > 0;
    fmt::print(
        "{} kind {} compared {} wrong {} -> {} ratio {:.2f} oracle {:.5f} (uniform {:.5f}) gain {:.2f} fallback {} "
        "inner {:.3f}\n",
        i, static_cast<int>(light.kind), perspective.compared, uniform.wrong, perspective.wrong,
        ratio_of(perspective.wrong, uniform.wrong), oracle, uniform.oracle_fraction.value_or(1),
        results[1].counters.at("gain").empty() ? 0.0 : results[1].counters.at("gain").front(),
        results[1].counters.at("fallback").front(), inner);
    std::fflush(stdout);
  }
  all.print("all");
  free_space.print("cameras in free space");
  chance.print(("these, " + other_texels).c_str());
  if (compared_total == 0) return 1;
  fmt::print("all: oracle overall {:.6f}, worst {:.5f}, above bar {}, pixels beyond snapping {}; with fallback {}\n",
             static_cast<double>(oracle_wrong) / static_cast<double>(compared_total), worst_oracle, bad_oracles,
             beyond_snapping, fallbacks);
}
