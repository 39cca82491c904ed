// One row a result, for spreadsheets and plotting scripts; RFC 4180 (quotes doubled, lines end in CRLF). Scene and
// device lead each row, so that the tables of many runs can be joined. Stages and counters get a column for every name
// that occurs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shadewright/compare/report.h"

namespace shadewright::compare {
namespace {

using Row = std::vector<std::string>;

std::string quote(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string quoted = "\"";
  for (const char c : field) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string line(const Row& fields) {
  std::string text;
  for (const std::string& field : fields) {
    if (&field != fields.data()) text += ',';
    text += quote(field);
  }
  return text + "\r\n";
}

// The shortest text that reads back as the same number; empty where there is none.
std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}
std::string number(uint64_t value) {
  return std::to_string(value);
}
std::string number(const std::optional<double>& value) {
  return value ? number(*value) : std::string();
}

std::string numbers(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += ' ';
    text += number(value);
  }
  return text;
}

void add_name(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

}  // namespace

std::string to_csv(const Report& report) {
  std::vector<std::string> stages, counters;
  for (const TechniqueResult& result : report.results) {
    for (const StageTime& stage : result.milliseconds.stages) add_name(stages, stage.name);
    for (const auto& [name, values] : result.counters) add_name(counters, name);
  }

  Row header = {"scene",
                "device",
                "width",
                "height",
                "path",
                "frames",
                "technique",
                "spec",
                "wrong",
                "compared",
                "image_pixels",
                "fraction",
                "match",
                "false_shadow",
                "false_lit",
                "interior_false_shadow",
                "interior_false_lit",
                "oracle_fraction",
                "edge_pixels",
                "boundary_fraction",
                "mean_absolute",
                "flicker",
                "milliseconds",
                "milliseconds_min",
                "milliseconds_max",
                "frame_milliseconds",
                "memory_bytes"};
  for (const std::string& name : stages) header.push_back("stage " + name);
  for (const std::string& name : counters) header.push_back("counter " + name);

  std::string text = line(header);
  for (const TechniqueResult& result : report.results) {
    const ErrorFigures& error = result.error;
    const Timing& time = result.milliseconds;
    Row row = {report.scene_name,
               report.device_name,
               number(uint64_t{report.width}),
               number(uint64_t{report.height}),
               report.path ? report.path->name : std::string(),
               number(uint64_t{report.path ? report.path->frames : 1}),
               result.technique,
               result.spec,
               number(error.wrong),
               number(error.compared),
               number(error.image_pixels),
               number(error.fraction),
               number(error.match),
               number(error.false_shadow),
               number(error.false_lit),
               number(error.interior_false_shadow),
               number(error.interior_false_lit),
               number(error.oracle_fraction),
               number(error.edge_pixels),
               number(error.boundary_fraction),
               number(error.mean_absolute),
               number(error.flicker),
               number(time.median),
               number(time.min),
               number(time.max),
               number(result.frame_milliseconds),
               number(result.memory_bytes())};
    for (const std::string& name : stages) {
      const auto stage =
          std::find_if(time.stages.begin(), time.stages.end(), [&](const auto& s) { return s.name == name; });
      row.push_back(stage == time.stages.end() ? std::string() : number(stage->median));
    }
    for (const std::string& name : counters) {
      const auto counter = result.counters.find(name);
      row.push_back(counter == result.counters.end() ? std::string() : numbers(counter->second));
    }
    text += line(row);
  }
  return text;
}

}  // namespace shadewright::compare
