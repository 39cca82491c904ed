// shadewright query: visibility of world points from a baked shadow, a line each.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <charconv>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "shadewright/error.h"
#include "shadewright/files.h"
#include "shadewright/voxel/file.h"
#include "verbs.h"

namespace shadewright::app {

namespace {

/// The place that points are told to the look-up from: floats of the file's own coordinates may be metres apart.
glm::dvec3 middle(const voxel::LightGrid& light) {
  if (light.kind == LightKind::spot) return light.position();
  const glm::dvec4 voxel(0.5 * light.size(), 0.5 * light.size(), 0.5 * light.depth(), 1);
  return glm::dvec3(glm::inverse(light.voxel_from_world) * voxel);
}

/// "x y z [nx ny nz]" seen from `origin`; InputError naming the line.
SurfacePoint parse_point(const std::string& line, size_t number, const glm::dvec3& origin) {
  double values[6] = {};
  int count = 0;
  const char* at = line.data();
  const char* const end = at + line.size();
  while (true) {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
    if (at == end) break;
    const auto [next, error] =
        count < 6 ? std::from_chars(at, end, values[count]) : std::from_chars_result{at, std::errc::invalid_argument};
    if (error != std::errc() || !std::isfinite(static_cast<float>(values[count])) ||
        (next != end && *next != ' ' && *next != '\t' && *next != '\r')) {
      count = -1;
      break;
    }
    ++count;
    at = next;
  }
  if (count != 3 && count != 6)
    throw InputError(fmt::format("line {} of standard input", number), fmt::format("'{}' is not a point", line),
                     "write x y z, or x y z nx ny nz");
  return {glm::vec3(glm::dvec3(values[0], values[1], values[2]) - origin), glm::vec3(values[3], values[4], values[5])};
}

void run(const std::string& file, uint32_t taps) {
  std::ios::sync_with_stdio(false);  // else in_avail knows of no character
  const voxel::VoxelShadow opened = voxel::open(file);
  const glm::dvec3 origin = middle(opened.light());
  const voxel::VoxelShadow shadow = opened.moved(-origin);
  constexpr size_t batch = 1 << 16;
  std::vector<SurfacePoint> points;
  std::vector<float> visibility;
  size_t number = 0;
  const auto answer = [&] {
    visibility.resize(points.size());
    shadow.visibility(points, taps, visibility);
    std::string text;
    for (const float v : visibility) text += fmt::format("{:.6g}\n", v);
    write_standard_output(text);
    points.clear();
  };
  for (std::string line; std::getline(std::cin, line);) {
    points.push_back(parse_point(line, ++number, origin));
    // Answers come as soon as nothing more waits to be read, so that a program can talk to us line by line.
    if (points.size() == batch || std::cin.rdbuf()->in_avail() <= 0) answer();
  }
  answer();
}

}  // namespace

void add_query(CLI::App& app) {
  auto file = std::make_shared<std::string>();
  auto taps = std::make_shared<uint32_t>(1);
  CLI::App* verb = app.add_subcommand("query", "Ask a .cpvs file for the visibility of world points");
  verb->add_option("FILE", *file, "FILE.cpvs")->required();
  verb->add_option("--filter", *taps, "Filter width in voxels: 1, 3, .. 17 (at most what was baked)")
      ->capture_default_str();
  verb->footer(
      "Reads \"x y z [nx ny nz]\" a line on standard input, writes visibility 0..1 a line.\n"
      "Example: shadewright bake builtin:landscape -r 4096 -o sun.cpvs\n"
      "         echo \"0 1 0  0 1 0\" | shadewright query sun.cpvs --filter 9");
  verb->callback([file, taps] { run(*file, *taps); });
}

}  // namespace shadewright::app
