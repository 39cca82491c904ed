#include "shadow/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "shadewright/error.h"
#include "shadow/lookup_shaders.h"

namespace shadewright::shadow {

namespace {

constexpr Part all_parts[] = {
    {"parameterization", "uniform", "one matrix fitted to the receivers"},
    {"parameterization", "perspective", "perspective shadow maps (PSM 2002)"},
    {"parameterization", "cascaded", "cascaded shadow maps"},
    {"parameterization", "rectilinear", "rectilinear texture warping (RTW 2012)"},
    {"parameterization", "paged", "adaptive and resolution-matched maps (ASM 2001, RMSM 2007)"},
    {"parameterization", "precomputed", "a baked voxel DAG, no map (CPVS 2014): neither storage nor filter"},
    {"storage", "depth", "the depth of the closest occluder"},
    {"storage", "moments", "variance shadow maps (VSM 2006)"},
    {"storage", "subpixel", "sub-pixel shadow maps (SPSM 2014)"},
    {"storage", "triangle", "three vertices a texel (RGSM 2008)"},
    {"filter", "hard", "one texel answers"},
    {"filter", "pcf", "percentage-closer filtering"},
    {"filter", "aa", "the storage's own anti-aliasing"},
    {"filter", "trilinear", "two pages blended (RMSM)"},
};

/// What makes no sense, by name; an empty name stands for any.
struct Refusal {
  std::string_view parameterization, storage, filter, why;
};
constexpr Refusal refusals[] = {
    {"precomputed", "", "", "a voxel DAG is no map, it has neither storage nor filter"},
    {"paged", "moments", "", "a blur cannot cross missing pages"},
    {"uniform", "", "trilinear", "only paged maps have levels to blend"},
    {"perspective", "", "trilinear", "only paged maps have levels to blend"},
    {"cascaded", "", "trilinear", "only paged maps have levels to blend"},
    {"rectilinear", "", "trilinear", "only paged maps have levels to blend"},
    {"", "depth", "aa", "a depth has no anti-aliasing of its own, only subpixel storage has"},
    {"", "moments", "aa", "moments have no anti-aliasing of their own, only subpixel storage has"},
    {"", "triangle", "aa", "a triangle has no anti-aliasing of its own, only subpixel storage has"},
};

constexpr std::string_view without_point_lights[] = {"cascaded", "rectilinear", "precomputed"};

bool fits(std::string_view pattern, std::string_view name) {
  return pattern.empty() || pattern == name;
}

std::vector<std::string_view> names_on(std::string_view axis) {
  std::vector<std::string_view> names;
  for (const Part& part : all_parts)
    if (part.axis == axis) names.push_back(part.name);
  return names;
}

}  // namespace

std::span<const Part> parts() {
  return all_parts;
}

const Part* find_part(std::string_view axis, std::string_view name) {
  const auto* found = std::find_if(std::begin(all_parts), std::end(all_parts),
                                   [&](const Part& p) { return p.axis == axis && p.name == name; });
  return found == std::end(all_parts) ? nullptr : found;
}

Resolutions resolutions(std::string_view parameterization) {
  if (parameterization == "paged") return {1024, 131072, 32768};
  if (parameterization == "precomputed") return {64, 1048576, 16384};
  return {16, 16384, 2048};
}

std::string why_refused(std::string_view parameterization, std::string_view storage, std::string_view filter) {
  for (const Refusal& refusal : refusals)
    if (fits(refusal.parameterization, parameterization) && fits(refusal.storage, storage) &&
        fits(refusal.filter, filter))
      return std::string(refusal.why);
  return {};
}

bool is_built(std::string_view parameterization, std::string_view storage, std::string_view filter) {
  for (const auto p : names_on("parameterization"))
    for (const auto s : names_on("storage"))
      for (const auto f : names_on("filter"))
        if (fits(parameterization, p) && fits(storage, s) && fits(filter, f) &&
            !lookup_shader(fmt::format("{}/{}/{}", p, s, f)).empty())
          return true;
  return false;
}

bool serves(std::string_view parameterization, LightKind light) {
  return light != LightKind::point || std::find(std::begin(without_point_lights), std::end(without_point_lights),
                                                parameterization) == std::end(without_point_lights);
}

void check_light(std::string_view parameterization, LightKind light) {
  if (!serves(parameterization, light))
    throw InputError(fmt::format("parameterization '{}'", parameterization),
                     "it has no six faces, so it can't serve a point light",
                     "choose uniform, perspective or paged, or a spot light");
}

std::string combinations_help() {
  std::string text = "Combinations that work (lights: all kinds unless said)\n";
  for (const auto p : names_on("parameterization")) {
    if (!is_built(p, "", "") && p != "precomputed") continue;
    text += fmt::format("  {}{}\n", p, serves(p, LightKind::point) ? "" : " (directional and spot lights)");
    for (const auto s : names_on("storage")) {
      std::string filters;
      for (const auto f : names_on("filter"))
        if (is_built(p, s, f)) filters += fmt::format(" {}", f);
      if (!filters.empty()) text += fmt::format("    {:<12}{}\n", s, filters);
    }
  }
  text += "Not built yet\n";
  for (const auto p : names_on("parameterization"))
    for (const auto s : names_on("storage"))
      for (const auto f : names_on("filter"))
        if (!is_built(p, s, f) && why_refused(p, s, f).empty()) text += fmt::format("  {}/{}/{}\n", p, s, f);
  text += "Refused\n";
  for (const Refusal& r : refusals)
    text += fmt::format("  {}/{}/{}: {}\n", r.parameterization.empty() ? "*" : r.parameterization,
                        r.storage.empty() ? "*" : r.storage, r.filter.empty() ? "*" : r.filter, r.why);
  return text;
}

}  // namespace shadewright::shadow
