// shadewright query: visibility of world points from a baked shadow, a line each.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "shadewright/error.h"
#include "shadewright/voxel/file.h"
#include "verbs.h"

namespace shadewright::app {

namespace {

/// "x y z [nx ny nz]"; InputError naming the line.
SurfacePoint parse_point(const std::string& line, size_t number) {
  float values[6] = {};
  int count = 0;
  const char* at = line.data();
  const char* const end = at + line.size();
  while (true) {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
    if (at == end) break;
    const auto [next, error] =
        count < 6 ? std::from_chars(at, end, values[count]) : std::from_chars_result{at, std::errc::invalid_argument};
    if (error != std::errc() || !std::isfinite(values[count]) ||
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
  return {{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
}

void run(const std::string& file, uint32_t taps) {
  const voxel::VoxelShadow shadow = voxel::open(file);
  constexpr size_t batch = 1 << 16;
  std::vector<SurfacePoint> points;
  std::vector<float> visibility;
  size_t number = 0;
  const auto answer = [&] {
    visibility.resize(points.size());
    shadow.visibility(points, taps, visibility);
    std::string text;
    for (const float v : visibility) text += fmt::format("{:.6g}\n", v);
    std::cout << text << std::flush;
    points.clear();
  };
  for (std::string line; std::getline(std::cin, line);) {
    points.push_back(parse_point(line, ++number));
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
      "Reads \"x y z [nx ny nz]\" a line on standard input, writes visibility 0..1 a line.\nExample: echo \"0 1 0  0 1 "
      "0\" | shadewright query sun.cpvs --filter 9");
  verb->callback([file, taps] { run(*file, *taps); });
}

}  // namespace shadewright::app
