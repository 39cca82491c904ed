#include "shadewright/shadow/spec.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>

#include "shadewright/error.h"

namespace shadewright::shadow {

namespace {

const std::string example = "an example that works: uniform/depth/pcf@2048,radius=2";

/// The parts of the three axes, and which of them are built. A part that is not is refused by name.
struct Part {
  std::string_view axis, name, stands_for;
  bool built;
};
constexpr Part parts[] = {
    {"parameterization", "uniform", "one matrix fitted to the receivers", true},
    {"parameterization", "perspective", "perspective shadow maps (PSM 2002)", false},
    {"parameterization", "cascaded", "cascaded shadow maps", false},
    {"parameterization", "rectilinear", "rectilinear texture warping (RTW 2012)", false},
    {"parameterization", "paged", "adaptive and resolution-matched maps (ASM 2001, RMSM 2007)", false},
    {"storage", "depth", "the depth of the closest occluder", true},
    {"storage", "moments", "variance shadow maps (VSM 2006)", false},
    {"storage", "subpixel", "sub-pixel shadow maps (SPSM 2014)", false},
    {"storage", "triangle", "three vertices a texel (RGSM 2008)", false},
    {"filter", "hard", "one texel answers", true},
    {"filter", "pcf", "percentage-closer filtering", true},
    {"filter", "aa", "the storage's own anti-aliasing", false},
    {"filter", "trilinear", "two pages blended (RMSM)", false},
};

const std::array<SpecAlias, 12> aliases{{{"sm", "uniform/depth/hard"},
                                         {"pcf", "uniform/depth/pcf"},
                                         {"vsm", "uniform/moments/pcf"},
                                         {"psm", "perspective/depth/hard"},
                                         {"csm", "cascaded/depth/pcf"},
                                         {"cpvs", "precomputed"},
                                         {"rtw", "rectilinear/depth/hard"},
                                         {"spsm", "uniform/subpixel/hard"},
                                         {"rgsm", "uniform/triangle/hard"},
                                         {"rmsm", "paged/depth/trilinear"},
                                         {"asm", "paged/depth/trilinear,refine=edges"},
                                         {"ray", "ray"}}};

const std::array<SpecKey, 4> keys{{
    {"bias", "map", {}, 0, 100, false, "1", "scale of the automatic bias; 1 is right on every scene"},
    {"fit",
     "uniform",
     {"scene", "view", "visible"},
     0,
     0,
     false,
     "view",
     "what receives: all of the scene, what the camera's frustum holds, or this frame's surface points"},
    {"radius", "pcf", {}, 0, 7, true, "1", "the filter's box reaches this many texels to each side"},
    {"width",
     "pcf",
     {},
     0,
     1000,
     false,
     "0",
     "the filter's whole width in metres, the same at every resolution; 0 = use radius"},
}};

constexpr uint32_t default_resolution = 2048, min_resolution = 16, max_resolution = 16384;

const Part* find_part(std::string_view axis, std::string_view name) {
  const auto* found =
      std::find_if(std::begin(parts), std::end(parts), [&](const Part& p) { return p.axis == axis && p.name == name; });
  return found == std::end(parts) ? nullptr : found;
}

std::string names(std::string_view axis) {
  std::vector<std::string_view> result;
  for (const Part& part : parts)
    if (part.axis == axis) result.push_back(part.name);
  return fmt::format("{}", fmt::join(result, ", "));
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> result;
  for (size_t begin = 0;;) {
    const size_t end = text.find(separator, begin);
    result.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return result;
    begin = end + 1;
  }
}

std::string refuse_unbuilt(const Part& part) {
  return fmt::format("{} '{}' ({}) is not built yet", part.axis, part.name, part.stands_for);
}

void check_part(const std::string& text, std::string_view axis, const std::string& name) {
  const Part* part = find_part(axis, name);
  if (!part)
    throw InputError(fmt::format("spec '{}'", text), fmt::format("there is no {} '{}'", axis, name),
                     fmt::format("choose one of {}; {}", names(axis), example));
  if (!part->built) throw InputError(fmt::format("spec '{}'", text), refuse_unbuilt(*part), example);
}

std::optional<double> parse_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

uint32_t parse_resolution(const std::string& text, std::string_view digits) {
  const auto number = parse_number(digits);
  if (!number || *number != std::floor(*number) || *number < min_resolution || *number > max_resolution)
    throw InputError(
        fmt::format("spec '{}'", text),
        fmt::format("resolution '{}' is not a whole number from {} to {}", digits, min_resolution, max_resolution),
        example);
  return static_cast<uint32_t>(*number);
}

const SpecKey& find_key(std::string_view name) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const SpecKey& key) { return key.name == name; });
  if (found == keys.end()) throw std::logic_error(fmt::format("no spec key '{}'", name));
  return *found;
}

bool belongs(const SpecKey& key, const Spec& spec) {
  return key.owner == "map" || key.owner == spec.parameterization || key.owner == spec.storage ||
         key.owner == spec.filter;
}

std::string value_range(const SpecKey& key) {
  if (!key.choices.empty()) return fmt::format("one of {}", fmt::join(key.choices, ", "));
  return fmt::format("{} from {} to {}", key.integer ? "a whole number" : "a number", key.min, key.max);
}

void parse_key(Spec& spec, std::string_view item, std::set<std::string_view>& seen) {
  const std::string subject = fmt::format("spec '{}'", spec.text);
  const size_t equals = item.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw InputError(subject, fmt::format("'{}' is not key=value", item), example);
  const std::string_view name = item.substr(0, equals), value = item.substr(equals + 1);
  const auto key = std::find_if(keys.begin(), keys.end(), [&](const SpecKey& k) { return k.name == name; });
  std::vector<std::string> own;
  for (const SpecKey& k : keys)
    if (belongs(k, spec)) own.push_back(k.name);
  const std::string choose = own.empty() ? "it takes no keys" : fmt::format("its keys are {}", fmt::join(own, ", "));
  if (key == keys.end()) throw InputError(subject, fmt::format("there is no key '{}'", name), choose);
  if (!belongs(*key, spec))
    throw InputError(subject, fmt::format("key '{}' belongs to '{}', which this spec does not use", name, key->owner),
                     choose);
  if (!seen.insert(name).second)
    throw InputError(subject, fmt::format("key '{}' is given twice", name), "give it once");
  bool good;
  if (!key->choices.empty()) {
    good = std::find(key->choices.begin(), key->choices.end(), value) != key->choices.end();
  } else {
    const auto number = parse_number(value);
    good = number && *number >= key->min && *number <= key->max && (!key->integer || *number == std::floor(*number));
  }
  if (!good)
    throw InputError(subject, fmt::format("{}={} is out of range", name, value),
                     fmt::format("give {}", value_range(*key)));
  if (value != key->default_value) spec.values.emplace(name, value);
}

/// Replaces an alias at the start of `text` ("pcf@512" -> "uniform/depth/pcf@512"; an alias's own keys go last).
std::string expand_alias(std::string_view text) {
  const size_t end = std::min({text.find('@'), text.find(','), text.find('/'), text.size()});
  for (const SpecAlias& alias : aliases) {
    if (alias.name != text.substr(0, end)) continue;
    const size_t comma = alias.spec.find(',');
    const std::string keys_of_alias = comma == std::string::npos ? "" : alias.spec.substr(comma);
    return alias.spec.substr(0, comma) + std::string(text.substr(end)) + keys_of_alias;
  }
  return std::string(text);
}

}  // namespace

std::span<const SpecKey> spec_keys() {
  return keys;
}
std::span<const SpecAlias> spec_aliases() {
  return aliases;
}

Spec parse_spec(std::string_view text) {
  Spec spec;
  spec.text = text;
  const std::string subject = fmt::format("spec '{}'", text);
  if (text.empty()) throw InputError("spec ''", "it is empty", example);
  const std::string expanded = expand_alias(text);
  const auto items = split(expanded, ',');
  std::string_view head = items[0];
  std::optional<std::string_view> resolution;
  if (const size_t at = head.find('@'); at != std::string_view::npos) {
    resolution = head.substr(at + 1);
    head = head.substr(0, at);
  }
  const auto axes = split(head, '/');
  spec.parameterization = axes[0];
  if (spec.parameterization == "precomputed")
    throw InputError(subject, "precomputed shadows in the frame are not built yet",
                     "use 'shadewright bake' and 'query'");
  if (spec.parameterization == "ray") {
    if (axes.size() > 1 || resolution || items.size() > 1)
      throw InputError(subject, "'ray' takes neither parts nor resolution nor keys", "write ray");
    return spec;
  }
  if (axes.size() > 3) throw InputError(subject, "it has more than parameterization/storage/filter", example);
  if (axes.size() == 1 && !find_part("parameterization", spec.parameterization)) {
    std::vector<std::string> known;
    for (const SpecAlias& alias : aliases) known.push_back(alias.name);
    throw InputError(subject, fmt::format("there is no technique or parameterization '{}'", spec.parameterization),
                     fmt::format("choose one of {} (aliases) or {} (parameterizations); {}", fmt::join(known, ", "),
                                 names("parameterization"), example));
  }
  spec.storage = axes.size() > 1 ? axes[1] : "depth";
  spec.filter = axes.size() > 2 ? axes[2] : "hard";
  check_part(spec.text, "parameterization", spec.parameterization);
  check_part(spec.text, "storage", spec.storage);
  check_part(spec.text, "filter", spec.filter);
  spec.resolution = resolution ? parse_resolution(spec.text, *resolution) : default_resolution;
  std::set<std::string_view> seen;
  for (size_t i = 1; i < items.size(); ++i) parse_key(spec, items[i], seen);
  return spec;
}

std::string Spec::canonical() const {
  if (storage.empty()) return parameterization;
  std::string result = fmt::format("{}/{}/{}@{}", parameterization, storage, filter, resolution);
  for (const auto& [key, value] : values) result += fmt::format(",{}={}", key, value);
  return result;
}

double Spec::number(std::string_view key) const {
  const auto found = values.find(key);
  return *parse_number(found == values.end() ? find_key(key).default_value : found->second);
}

std::string Spec::choice(std::string_view key) const {
  const auto found = values.find(key);
  return found == values.end() ? find_key(key).default_value : found->second;
}

std::vector<std::string> expand_sweep(std::string_view text) {
  const size_t at = text.find('@'), dots = text.find("..");
  if (at == std::string_view::npos || dots == std::string_view::npos || dots < at) return {std::string(text)};
  const size_t end = std::min(text.find(',', dots), text.size());
  const std::string whole(text);
  const uint32_t from = parse_resolution(whole, text.substr(at + 1, dots - at - 1));
  const uint32_t to = parse_resolution(whole, text.substr(dots + 2, end - dots - 2));
  if (from > to)
    throw InputError(fmt::format("spec '{}'", text), "the sweep runs downwards", fmt::format("write {}..{}", to, from));
  std::vector<std::string> result;
  for (uint32_t resolution = from; resolution <= to; resolution *= 2)
    result.push_back(fmt::format("{}@{}{}", text.substr(0, at), resolution, text.substr(end)));
  return result;
}

std::string spec_help() {
  std::string text =
      "SPEC is parameterization/storage/filter@resolution,key=value,...; trailing parts may be left out.\n\nAliases\n";
  for (const SpecAlias& alias : aliases) text += fmt::format("  {:<8} {}\n", alias.name, alias.spec);
  for (const std::string_view axis : {"parameterization", "storage", "filter"}) {
    text += fmt::format("\n{}\n", axis);
    for (const Part& part : parts)
      if (part.axis == axis)
        text += fmt::format("  {:<12} {}{}\n", part.name, part.stands_for, part.built ? "" : " (not built yet)");
  }
  text += fmt::format("\nresolution: texels per axis, {} to {}, default {}\n\nKeys\n", min_resolution, max_resolution,
                      default_resolution);
  for (const SpecKey& key : keys)
    text += fmt::format("  {:<8} {:<8} {} (default {}): {}\n", key.name, key.owner, value_range(key), key.default_value,
                        key.help);
  text += "\nLights: uniform serves directional, spot and point lights (six faces).\n";
  return text;
}

}  // namespace shadewright::shadow
