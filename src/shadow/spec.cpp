#include "shadewright/shadow/spec.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>

#include "shadewright/error.h"
#include "shadow/filter/reach.h"
#include "shadow/parts.h"

namespace shadewright::shadow {

namespace {

const std::string example = "an example that works: uniform/depth/pcf@2048,radius=2";

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

SpecKey number_key(std::string name, std::string owner, double min, double max, std::string standard,
                   std::string help) {
  return {SpecKey::Kind::number, std::move(name), std::move(owner), {}, min, max, std::move(standard), std::move(help)};
}
SpecKey whole_key(std::string name, std::string owner, double min, double max, std::string standard, std::string help) {
  return {SpecKey::Kind::whole, std::move(name), std::move(owner), {}, min, max, std::move(standard), std::move(help)};
}
/// The first choice is the default unless `standard` names another.
SpecKey choice_key(std::string name, std::string owner, std::vector<std::string> choices, std::string help,
                   std::string standard = {}) {
  if (standard.empty()) standard = choices.front();
  return {SpecKey::Kind::choice, std::move(name), std::move(owner), std::move(choices), 0, 0,
          std::move(standard),   std::move(help)};
}

const std::vector<SpecKey>& all_keys() {
  static const std::vector<SpecKey> keys{
      number_key("bias", "map", 0, 100, "1", "scale of the automatic bias; 1 is right on every scene"),
      choice_key("fit", "uniform", {"view", "scene", "visible"},
                 "what receives: what the camera's frustum holds, all of the scene, or this frame's surface points"),
      choice_key("slopes", "subpixel", {"wide", "power", "linear"},
                 "how a texel codes slopes and depth: 11 bits a slope and depth within the texel, the paper's 8 bits "
                 "by the fifth power, or 8 bits linear in the angle"),
      choice_key("kernel", "triangle", {"3", "5"}, "the receiver's ray meets the triangles of 3x3 or 5x5 texels"),
      choice_key("recovery", "subpixel", {"silhouettes", "tangents", "off"},
                 "who neither their texel nor its neighbours cover: decided by the silhouettes around, by the paper's "
                 "tangents, or lit"),
      choice_key("warp", "perspective", {"best", "psm", "lispsm"},
                 "how the matrix is chosen: of all projections the one with the smallest texels, perspective shadow "
                 "maps (2002), or light space ones (Wimmer 2004)"),
      choice_key("shift", "perspective", {"best", "least"},
                 "of warp=psm: the eye moves back to where texels are smallest, or as little as the paper asks"),
      choice_key("fit", "perspective", {"visible", "view"},
                 "what receives: this frame's surface points, or without waiting what the camera's frustum holds"),
      choice_key("fallback", "perspective", {"on", "off"},
                 "on: a uniform map where that has smaller texels; off: the projection as it is, to study it"),
      choice_key("analysis_scale", "paged", {"1", "2", "4", "8"},
                 "requests come from every so many pixels along each axis; what they miss, a backup of 1,024 texels "
                 "serves, or a coarser page that is there"),
      whole_key("finest", "paged", 1024, 131072, "131072",
                "texels per axis of the finest level that may be asked for: less costs less and shows less"),
      whole_key("pool", "paged", 1024, 8192, "4096", "texels per axis of the image that holds the pages"),
      choice_key("cache", "paged", {"off", "on"},
                 "keep pages from frame to frame and draw only what is new, or touched by a caster that moved"),
      choice_key(
          "refine", "paged", {"none", "edges"},
          "none: draw what each pixel asks for (RMSM); edges: start coarse and refine shadow edges until no pixel "
          "asks for more (ASM)"),
      choice_key("requests", "paged", {"bits", "sort"},
                 "bits: pixels mark pages in a bitmask; sort: RMSM's list of requests, made unique by connected "
                 "components, compaction, sort and compaction"),
      choice_key("uniquify", "paged", {"auto", "none", "components", "compact", "full"},
                 "how far the list of requests (this key asks for it) is thinned before it is used: not, by connected "
                 "components, compacted too, or sorted and made unique too (auto: full; none with analysis=cpu)"),
      choice_key("analysis", "paged", {"gpu", "cpu"},
                 "who finds the pages in what pixels ask for: the device, or the host in a list that it reads back"),
      choice_key(
          "draw", "paged", {"pages", "superpages"},
          "pages: straight into the pool; superpages: RMSM's way, 1,024^2 texels of a level by each pass over the "
          "casters, out of which pages are copied"),
      choice_key("statistics", "paged", {"off", "on"},
                 "also count how the filter's taps are answered and how much of the pages they read"),
      choice_key("lod", "paged", {"bounded", "area", "box", "axis"},
                 "a pixel's size in the map: its area bounded by twice its ellipse's smaller axis, its area (RMSM "
                 "equation 1), "
                 "its longer side, or that axis"),
      choice_key("analysis", "rectilinear", {"backward", "forward", "hybrid"},
                 "importance from the camera's buffers, from a depth image of the light's, or from both"),
      choice_key("dv", "rectilinear", {"on", "off"}, "importance: only what the camera sees counts"),
      choice_key("de", "rectilinear", {"off", "on"}, "importance: nearer the eye counts more"),
      choice_key("sn", "rectilinear", {"off", "on"}, "importance: surfaces that face the eye count more"),
      number_key("beta", "rectilinear", 0, 100, "2", "how much more, for sn"),
      choice_key("se", "rectilinear", {"auto", "on", "off"},
                 "importance: shadow edges count more; forward and hybrid analysis, where auto means on"),
      choice_key("px", "rectilinear", {"on", "off"}, "importance: the pixels that a step of the map covers"),
      choice_key(
          "collapse", "rectilinear", {"sum", "max"},
          "a row's share follows the root of its importance's sum, the least error in all, or its maximum (the paper)"),
      choice_key("map", "rectilinear", {"1d", "2d"},
                 "importance by rows and columns, or in a map of cells x cells first"),
      whole_key("image", "rectilinear", 64, 4096, "512",
                "size of the light's depth image, forward and hybrid analysis"),
      choice_key("tessellation", "rectilinear", {"exact", "off", "5", "2.5", "1"},
                 "casters' edges, which bend: exact, straight, or cut to a percentage of the map's width"),
      whole_key("segments", "rectilinear", 1, 64, "8",
                "an axis' linear pieces, at most, where casters' edges are exact; else every super-cell is one"),
      choice_key("rotate", "rectilinear", {"off", "on"},
                 "turn the light's image plane to where the error is least, not to where receivers fit tightest"),
      number_key("temporal", "rectilinear", 0, 0.99, "0", "how much of last frame's importance stays"),
      whole_key("cells", "rectilinear", 8, 2048, "1024", "super-cells along each axis"),
      number_key("sigma", "rectilinear", 0, 16, "1", "blur of the importance, super-cells"),
      whole_key("radius", "pcf", 0, 8, "1", "the filter's box reaches this many texels to each side"),
      whole_key("cascades", "cascaded", 1, 8, "4", "slices of the view, each with a map of its own"),
      number_key("lambda", "cascaded", 0, 1, "0.85", "where to split: lambda * logarithmic + (1 - lambda) * linear"),
      choice_key("splits", "cascaded", {"pssm", "sdsm"},
                 "what to split and fit to: what the camera's frustum holds, or this frame's surface points"),
      choice_key(
          "stable", "cascaded", {"0", "1"},
          "1: maps keep their size or take a step of it, and move by whole texels: a moving camera does not shimmer"),
      whole_key("blur", "moments/pcf", 0, 16, "1", "moments are averaged over this many texels to each side"),
      number_key("bleeding", "moments", 0, 0.99, "0",
                 "light-bleeding reduction: the share of light that counts as none; hardens the shadow's edge"),
      number_key("width", "pcf", 0, 1000, "0",
                 "the filter's whole width in metres, the same at every resolution; 0 = use radius"),
      choice_key("taps", "precomputed", {"1", "3", "5", "7", "9", "11", "13", "15", "17"},
                 "the filter averages this many voxels along x and y"),
      choice_key("far", "precomputed", {"none", "mraa", "voaa"},
                 "receivers whose pixel is wider than the filter: no more, coarser DAGs, or occupancy"),
      {SpecKey::Kind::file, "file", "precomputed", {}, 0, 0, "", "a baked .cpvs file; without it the scene is baked"},
      {SpecKey::Kind::spec, "dynamic", "precomputed", {}, 0, 0, "", "the map technique that draws what moves"},
      choice_key("closed", "precomputed", {"auto", "all", "none"}, "bake: whose inside may be left undefined"),
      choice_key("static", "precomputed", {"0", "1"}, "bake: 1 = nothing that moves receives, smaller"),
      choice_key("order", "precomputed", {"auto", "best", "fixed", "leaves"},
                 "a filter's leaves in the order with the shortest ways back, always x first, or each on its own from "
                 "where they part (auto: that on a CPU device, else best)"),
      choice_key("access", "precomputed", {"auto", "windows", "image", "address"},
                 "how the device reads the DAG: storage windows, an image, a buffer's address"),
      choice_key("precision", "precomputed", {"auto", "float", "double"},
                 "of the receiver's voxel: double is exact, and fast on a CPU device"),
  };
  return keys;
}

std::string names(std::string_view axis) {
  std::vector<std::string_view> result;
  for (const Part& part : parts())
    if (part.axis == axis) result.push_back(part.name);
  return fmt::format("{}", fmt::join(result, ", "));
}

/// Splits at `separator`, but not inside parentheses, in which a nested spec stands.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> result;
  size_t begin = 0;
  int depth = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (text[i] != separator || depth != 0) continue;
    result.push_back(text.substr(begin, i - begin));
    begin = i + 1;
  }
  result.push_back(text.substr(begin));
  return result;
}

void check_part(const std::string& text, std::string_view axis, const std::string& name) {
  if (!find_part(axis, name))
    throw InputError(fmt::format("spec '{}'", text), fmt::format("there is no {} '{}'", axis, name),
                     fmt::format("choose one of {}; {}", names(axis), example));
}

/// Refuses combinations that make no sense, and those that are not built.
void check_combination(const Spec& spec) {
  const std::string subject = fmt::format("spec '{}'", spec.text);
  const std::string combination = fmt::format("{}/{}/{}", spec.parameterization, spec.storage, spec.filter);
  if (const std::string why = why_refused(spec.parameterization, spec.storage, spec.filter); !why.empty())
    throw InputError(subject, fmt::format("{} makes no sense: {}", combination, why), example);
  if (!is_built(spec.parameterization, spec.storage, spec.filter))
    throw InputError(subject, fmt::format("{} is not built yet", combination),
                     "'shadewright render --help-spec' lists what is");
}

std::optional<double> parse_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

uint32_t parse_resolution(const std::string& text, std::string_view digits, const Resolutions& allowed) {
  const auto number = parse_number(digits);
  if (!number || *number != std::floor(*number) || *number < allowed.min || *number > allowed.max)
    throw InputError(
        fmt::format("spec '{}'", text),
        fmt::format("resolution '{}' is not a whole number from {} to {}", digits, allowed.min, allowed.max), example);
  return static_cast<uint32_t>(*number);
}

/// Texels averaged beforehand leave the filter one look-up, and nothing to choose.
bool prefiltered(const Spec& spec) {
  return spec.storage == "moments";
}

bool belongs(const SpecKey& key, const Spec& spec) {
  return (key.owner == "map" && !spec.storage.empty()) || key.owner == spec.parameterization ||
         key.owner == spec.storage || key.owner == spec.storage + "/" + spec.filter ||
         (key.owner == spec.filter && !prefiltered(spec));
}

/// The key of that name which belongs to a part of `spec` (parts may use the same name); null if there is none.
const SpecKey* find_key(std::string_view name, const Spec& spec) {
  for (const SpecKey& key : all_keys())
    if (key.name == name && belongs(key, spec)) return &key;
  return nullptr;
}

const std::string& value_of(const Spec& spec, std::string_view name) {
  if (const auto found = spec.values.find(name); found != spec.values.end()) return found->second;
  const SpecKey* key = find_key(name, spec);
  if (!key) throw std::logic_error(fmt::format("spec '{}' has no key '{}'", spec.text, name));
  return key->default_value;
}

std::string value_range(const SpecKey& key) {
  switch (key.kind) {
    case SpecKey::Kind::choice:
      return fmt::format("one of {}", fmt::join(key.choices, ", "));
    case SpecKey::Kind::number:
      return fmt::format("a number from {} to {}", key.min, key.max);
    case SpecKey::Kind::whole:
      return fmt::format("a whole number from {} to {}", key.min, key.max);
    case SpecKey::Kind::file:
      return "a file's path";
    case SpecKey::Kind::spec:
      return "a spec in parentheses";
  }
  return {};
}

/// `value` in its shortest form; nothing where it can't be the value of `key`. Throws what a nested spec throws.
std::optional<std::string> canonical_value(const SpecKey& key, std::string_view value) {
  switch (key.kind) {
    case SpecKey::Kind::choice:
      if (std::find(key.choices.begin(), key.choices.end(), value) == key.choices.end()) return std::nullopt;
      break;
    case SpecKey::Kind::number:
    case SpecKey::Kind::whole: {
      const auto number = parse_number(value);
      if (!number || *number < key.min || *number > key.max) return std::nullopt;
      if (key.kind == SpecKey::Kind::whole && *number != std::floor(*number)) return std::nullopt;
      return fmt::format("{}", *number + 0.0);  // adding zero turns -0 into 0
    }
    case SpecKey::Kind::file:
      if (value.empty()) return std::nullopt;
      break;
    case SpecKey::Kind::spec:
      if (value.size() < 2 || value.front() != '(' || value.back() != ')') return std::nullopt;
      return fmt::format("({})", parse_spec(value.substr(1, value.size() - 2)).canonical());
  }
  return std::string(value);
}

void parse_key(Spec& spec, std::string_view item, std::set<std::string_view>& seen, const SpecAlias* setter) {
  const std::string subject = fmt::format("spec '{}'", spec.text);
  const size_t equals = item.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw InputError(subject, fmt::format("'{}' is not key=value", item), example);
  const std::string_view name = item.substr(0, equals), value = item.substr(equals + 1);
  std::vector<std::string_view> own;
  std::string_view other_owner;
  for (const SpecKey& key : all_keys()) {
    if (belongs(key, spec)) own.push_back(key.name);
    if (key.name == name) other_owner = key.owner;
  }
  const std::string choose = own.empty() ? "it takes no keys" : fmt::format("its keys are {}", fmt::join(own, ", "));
  const SpecKey* key = find_key(name, spec);
  if (!key && other_owner.empty()) throw InputError(subject, fmt::format("there is no key '{}'", name), choose);
  if (!key && other_owner == spec.filter)
    throw InputError(subject,
                     fmt::format("key '{}' has no meaning with '{}', which averages beforehand", name, spec.storage),
                     choose);
  if (!key)
    throw InputError(subject, fmt::format("key '{}' belongs to '{}', which this spec does not use", name, other_owner),
                     choose);
  const bool again = !seen.insert(name).second;
  if (again && setter)
    throw InputError(
        subject, fmt::format("'{}' sets {} itself", setter->name, item),
        fmt::format("write {} instead of {}", setter->spec.substr(0, setter->spec.find(',')), setter->name));
  if (again) throw InputError(subject, fmt::format("key '{}' is given twice", name), "give it once");
  const std::optional<std::string> canonical = canonical_value(*key, value);
  if (!canonical)
    throw InputError(subject, fmt::format("{}={} is out of range", name, value),
                     fmt::format("give {}", value_range(*key)));
  if (*canonical != key->default_value) spec.values.emplace(name, *canonical);
}

/// The resolution of a precomputed spec, and what its keys exclude.
void parse_precomputed(Spec& spec, std::optional<std::string_view> resolution) {
  const Resolutions allowed = resolutions(spec.parameterization);
  const bool from_file = !spec.choice("file").empty();
  if (resolution)
    spec.resolution = parse_resolution(spec.text, *resolution, allowed);
  else if (!from_file)
    spec.resolution = allowed.standard;
  if (!std::has_single_bit(spec.resolution) && spec.resolution != 0)
    throw InputError(fmt::format("spec '{}'", spec.text),
                     fmt::format("resolution {} is not a power of two", spec.resolution),
                     fmt::format("write {}", std::bit_ceil(spec.resolution)));
  if (const auto dynamic = spec.nested("dynamic"); dynamic && dynamic->storage.empty())
    throw InputError(fmt::format("spec '{}'", spec.text), "dynamic is not a map technique",
                     "write dynamic=(cascaded@2048)");
  if (spec.values.contains("dynamic") && spec.choice("static") == "1")
    throw InputError(fmt::format("spec '{}'", spec.text),
                     "a shadow baked for static receivers is undefined where moving ones can be", "leave static=1 out");
  for (const char* key : {"closed", "static"})
    if (from_file && spec.values.contains(key))
      throw InputError(fmt::format("spec '{}'", spec.text),
                       fmt::format("{} says how to bake, but the file is baked", key), "leave it out");
}

/// The alias at the start of `text`; null if there is none.
const SpecAlias* find_alias(std::string_view text) {
  const std::string_view name = text.substr(0, text.find_first_of("@,/"));
  const auto* found = std::find_if(aliases.begin(), aliases.end(), [&](const SpecAlias& a) { return a.name == name; });
  return found == aliases.end() ? nullptr : found;
}

/// Where a filter is wider than other maps, what it reads beyond their edge is lost.
void check_reach(const Spec& spec) {
  if (spec.parameterization != "cascaded") return;
  if (const uint32_t least = least_cascade_resolution(spec); spec.resolution < least)
    throw InputError(
        fmt::format("spec '{}'", spec.text),
        fmt::format("the filter reaches {} texels to each side, and a cascade of {} has no room for more",
                    filter_reach(spec).texels, spec.resolution),
        fmt::format("give @{} or more, or a smaller {}", least, spec.storage == "moments" ? "blur" : "radius"));
}

/// Replaces an alias at the start of `text` ("pcf@512" -> "uniform/depth/pcf@512"; an alias's own keys go last).
std::string expand_alias(std::string_view text) {
  const SpecAlias* alias = find_alias(text);
  if (!alias) return std::string(text);
  const size_t comma = std::min(alias->spec.find(','), alias->spec.size());
  return alias->spec.substr(0, comma) + std::string(text.substr(alias->name.size())) + alias->spec.substr(comma);
}

}  // namespace

std::span<const SpecKey> spec_keys() {
  return all_keys();
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
  if (spec.parameterization == "ray") {
    if (axes.size() > 1 || resolution || items.size() > 1)
      throw InputError(subject, "'ray' takes neither parts nor resolution nor keys", "write ray");
    return spec;
  }
  std::set<std::string_view> seen;
  const auto parse_keys = [&] {
    const size_t given = split(text, ',').size();  // an alias's own keys come after them
    for (size_t i = 1; i < items.size(); ++i) parse_key(spec, items[i], seen, i < given ? nullptr : find_alias(text));
  };
  if (spec.parameterization == "precomputed") {
    if (axes.size() > 1)
      throw InputError(subject, "'precomputed' has neither storage nor filter", "write precomputed@16384,taps=9");
    parse_keys();
    parse_precomputed(spec, resolution);
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
  check_combination(spec);
  const Resolutions allowed = resolutions(spec.parameterization);
  spec.resolution = resolution ? parse_resolution(spec.text, *resolution, allowed) : allowed.standard;
  parse_keys();
  check_reach(spec);
  return spec;
}

std::string Spec::canonical() const {
  std::string result = parameterization;
  if (!storage.empty()) result += fmt::format("/{}/{}", storage, filter);
  if (resolution != 0) result += fmt::format("@{}", resolution);
  for (const auto& [key, value] : values) result += fmt::format(",{}={}", key, value);
  return result;
}

double Spec::number(std::string_view key) const {
  return *parse_number(value_of(*this, key));
}

std::string Spec::choice(std::string_view key) const {
  return value_of(*this, key);
}

std::optional<Spec> Spec::nested(std::string_view key) const {
  const std::string& value = value_of(*this, key);
  if (value.empty()) return std::nullopt;
  return parse_spec(std::string_view(value).substr(1, value.size() - 2));
}

bool Spec::takes(std::string_view key) const {
  return find_key(key, *this) != nullptr;
}

std::vector<SpecKey> Spec::keys() const {
  std::vector<SpecKey> result;
  std::ranges::copy_if(all_keys(), std::back_inserter(result), [&](const SpecKey& key) { return belongs(key, *this); });
  return result;
}

std::vector<std::string> expand_sweep(std::string_view text) {
  const size_t end = std::min(text.find(','), text.size());
  const std::string_view head = text.substr(0, end);
  const size_t at = head.find('@'), dots = head.find("..");
  if (at == std::string_view::npos || dots == std::string_view::npos || dots < at) return {std::string(text)};
  const std::string whole(text);
  const std::string expanded = expand_alias(text);
  const Resolutions allowed = resolutions(expanded.substr(0, expanded.find_first_of("/@,")));
  const uint32_t from = parse_resolution(whole, text.substr(at + 1, dots - at - 1), allowed);
  const uint32_t to = parse_resolution(whole, text.substr(dots + 2, end - dots - 2), allowed);
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
    for (const Part& part : parts())
      if (part.axis == axis) text += fmt::format("  {:<17} {}\n", part.name, part.stands_for);
  }
  text += "\n" + combinations_help() + "\nresolution, default\n";
  for (const Part& part : parts())
    if (part.axis == "parameterization") {
      const Resolutions allowed = resolutions(part.name);
      text += fmt::format("  {:<17} {} to {} {} per axis, {}\n", part.name, allowed.min, allowed.max,
                          part.name == "precomputed" ? "voxels (a power of two)" : "texels", allowed.standard);
    }
  text += "\nKeys\n";
  for (const SpecKey& key : all_keys())
    text += fmt::format("  {:<10} {:<12} {} (default {}): {}\n", key.name, key.owner, value_range(key),
                        key.default_value, key.help);
  return text;
}

}  // namespace shadewright::shadow
