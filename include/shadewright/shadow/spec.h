// A spec names a technique: parameterization/storage/filter@resolution,key=value,... (architecture, section 1).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shadewright::shadow {

struct SpecKey;

/// A parsed spec. Every key is known, belongs to a part of this technique and is in range.
struct Spec {
  std::string text;              ///< as given
  std::string parameterization;  ///< "uniform", ..., or "precomputed", or "ray"
  std::string storage, filter;   ///< empty for "precomputed" and "ray"
  uint32_t resolution = 0;       ///< texels per axis; 0 where it has no meaning ("ray")
  std::map<std::string, std::string, std::less<>>
      values;  ///< numbers in shortest form, nested specs canonical, defaults left out

  /// The whole spec with aliases written out, keys in alphabetical order: "uniform/depth/pcf@2048,radius=2".
  std::string canonical() const;

  /// The value of `key`, or its default. Logic error for an unknown key or another type.
  double number(std::string_view key) const;
  std::string choice(std::string_view key) const;
  /// The spec in parentheses that is the key's value; nothing where there is none.
  std::optional<Spec> nested(std::string_view key) const;
  /// True if this technique takes the key at all.
  bool takes(std::string_view key) const;
  /// All keys that it takes.
  std::vector<SpecKey> keys() const;
};

/// One key of a spec.
struct SpecKey {
  enum class Kind { number, whole, choice, file, spec };
  Kind kind = Kind::number;
  std::string name;
  std::string owner;                 ///< "map" (every map technique), a parameterization, storage or filter
  std::vector<std::string> choices;  ///< of a choice
  double min = 0, max = 0;           ///< of a number
  std::string default_value;
  std::string help;
};

/// All keys there are.
std::span<const SpecKey> spec_keys();

/// An alias and what it stands for ("pcf", "uniform/depth/pcf").
struct SpecAlias {
  std::string name, spec;
};
std::span<const SpecAlias> spec_aliases();

/// Parses one spec. InputError says what is wrong with it, with an example that works; combinations that make no sense,
/// and parts that are not built yet, are refused by name.
Spec parse_spec(std::string_view text);

/// Expands a sweep "sm@512..4096" into specs at each power of two from the first to the last; others stand for
/// themselves.
std::vector<std::string> expand_sweep(std::string_view text);

/// The table of aliases, parts, keys and legal combinations, for `--help-spec`.
std::string spec_help();

}  // namespace shadewright::shadow
