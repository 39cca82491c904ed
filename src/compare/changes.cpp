// What changed between two reports, paired by canonical spec.
#include "compare/changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

namespace shadewright::compare {
namespace {

const std::string& key(const TechniqueResult& result) {
  return result.spec.empty() ? result.technique : result.spec;
}

// A report that was read back from JSON has its angles and directions rounded.
bool near(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::distance(a, b) <= 1e-9 * std::max(1.0, glm::length(a));
}
bool near(double a, double b) {
  return std::abs(a - b) <= 1e-9;
}

bool same(const Camera& a, const Camera& b) {
  return near(a.eye, b.eye) && near(a.target, b.target) && near(a.up, b.up) && near(a.fov_y, b.fov_y);
}

bool same(const Light& a, const Light& b) {
  if (a.kind != b.kind) return false;
  if (a.kind != LightKind::point && !near(a.direction, b.direction)) return false;
  if (a.kind != LightKind::directional && !near(a.position, b.position)) return false;
  return a.kind != LightKind::spot || near(a.outer_angle, b.outer_angle);
}

bool same(const std::optional<ReportPath>& a, const std::optional<ReportPath>& b) {
  if (!a || !b) return !a && !b;
  return a->name == b->name && a->frames == b->frames && near(a->first_time, b->first_time) &&
         near(a->last_time, b->last_time) && a->light_moves == b->light_moves;
}

std::string relative(double before, double after) {
  if (before == after) return "(same)";
  if (before == 0) return "";
  return fmt::format("({:+.1f}%)", 100.0 * (after - before) / before);
}

double megabytes(const TechniqueResult& result) {
  return static_cast<double>(result.memory_bytes()) / 1e6;
}

/// One line of the table. A quantity is three cells: before, after, relative change; a technique in one report has "-"
/// for the other's.
constexpr std::array<std::string_view, 3> quantities = {"wrong pixels", "milliseconds", "MB"};
constexpr size_t cells = 1 + 3 * quantities.size();
using Line = std::array<std::string, cells>;

template <class Figure, class Format>
void add_quantity(Line& line, size_t first, const Change& change, const Figure& figure, const Format& format) {
  line[first] = change.before ? format(figure(*change.before)) : "-";
  line[first + 1] = change.after ? format(figure(*change.after)) : "-";
  if (change.before && change.after)
    line[first + 2] = relative(static_cast<double>(figure(*change.before)), static_cast<double>(figure(*change.after)));
}

Line line(const Change& change) {
  Line line;
  line[0] = change.after ? change.after->technique : change.before->technique;
  add_quantity(
      line, 1, change, [](const TechniqueResult& r) { return r.error.wrong; },
      [](uint64_t wrong) { return fmt::format("{}", wrong); });
  add_quantity(
      line, 4, change, [](const TechniqueResult& r) { return r.milliseconds.median; },
      [](double milliseconds) { return fmt::format("{:.2f}", milliseconds); });
  add_quantity(line, 7, change, megabytes, [](double mb) { return fmt::format("{:.1f}", mb); });
  return line;
}

}  // namespace

std::vector<Change> pair_results(const Report& before, const Report& after) {
  std::vector<const TechniqueResult*> unpaired;
  for (const TechniqueResult& result : before.results) unpaired.push_back(&result);
  std::vector<Change> changes;
  for (const TechniqueResult& result : after.results) {
    const auto old = std::find_if(unpaired.begin(), unpaired.end(),
                                  [&](const TechniqueResult* candidate) { return key(*candidate) == key(result); });
    changes.push_back({old == unpaired.end() ? nullptr : *old, &result});
    if (old != unpaired.end()) unpaired.erase(old);
  }
  for (const TechniqueResult* result : unpaired) changes.push_back({result, nullptr});
  return changes;
}

std::vector<std::string> changed_conditions(const Report& before, const Report& after) {
  std::vector<std::string> conditions;
  const auto differs = [&](const char* what, const std::string& was, const std::string& is) {
    if (was != is) conditions.push_back(fmt::format("the {} differs: {} before, {} now", what, was, is));
  };
  differs("scene", before.scene_name, after.scene_name);
  if (before.scene_name == after.scene_name)
    differs("scene's number of triangles", std::to_string(before.triangles), std::to_string(after.triangles));
  differs("device", before.device_name, after.device_name);
  differs("image size", fmt::format("{} x {}", before.width, before.height),
          fmt::format("{} x {}", after.width, after.height));
  if (!same(before.path, after.path)) conditions.emplace_back("the camera path or its frames differ");
  if (!same(before.camera, after.camera)) conditions.emplace_back("the camera differs");
  if (!same(before.light, after.light)) conditions.emplace_back("the light differs");
  return conditions;
}

std::string describe_changes(const Report& before, const Report& after) {
  const std::vector<Change> changes = pair_results(before, after);
  std::vector<Line> lines;
  lines.reserve(changes.size());
  for (const Change& change : changes) lines.push_back(line(change));
  std::array<size_t, cells> width{};
  width[0] = std::string_view("technique").size();
  for (const Line& l : lines)
    for (size_t c = 0; c < cells; ++c) width[c] = std::max(width[c], l[c].size());

  std::string text;
  const auto add = [&text](std::string row) {
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + "\n";
  };
  for (const std::string& condition : changed_conditions(before, after)) add("note: " + condition);
  if (changes.empty()) return text;

  std::string header = fmt::format("{:<{}}", "technique", width[0]);
  for (size_t q = 0; q < quantities.size(); ++q) {
    const size_t c = 1 + 3 * q;
    header += fmt::format("  {:<{}}", quantities[q], width[c] + width[c + 1] + width[c + 2] + std::strlen(" ->  "));
  }
  add(header);
  for (size_t i = 0; i < lines.size(); ++i) {
    const Line& l = lines[i];
    std::string row = fmt::format("{:<{}}", l[0], width[0]);
    for (size_t c = 1; c < cells; c += 3)
      row += fmt::format("  {:>{}} -> {:>{}} {:<{}}", l[c], width[c], l[c + 1], width[c + 1], l[c + 2], width[c + 2]);
    if (!changes[i].before) row += "  new";
    if (!changes[i].after) row += "  gone";
    add(row);
  }
  return text;
}

}  // namespace shadewright::compare
