// The parts that techniques are made of, and which of them go together: the one table (architecture, section 1).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "shadewright/scene/scene.h"

namespace shadewright::shadow {

/// A choice on one of the three axes; "precomputed" stands among the parameterizations, though it is no map.
struct Part {
  std::string_view axis, name, stands_for;
};
std::span<const Part> parts();
/// Null where there is none.
const Part* find_part(std::string_view axis, std::string_view name);

/// What "@" may be for a parameterization: texels per axis (for "precomputed", voxels).
struct Resolutions {
  uint32_t min, max, standard;
};
Resolutions resolutions(std::string_view parameterization);

/// Why a combination makes no sense, one sentence; empty for one that does.
std::string why_refused(std::string_view parameterization, std::string_view storage, std::string_view filter);
/// True if the library holds the shaders of the combination. An empty name stands for any.
bool is_built(std::string_view parameterization, std::string_view storage, std::string_view filter);

/// True if the parameterization ("precomputed" too) serves lights of this kind.
bool serves(std::string_view parameterization, LightKind light);
/// InputError where the parameterization serves no light of this kind.
void check_light(std::string_view parameterization, LightKind light);

/// The table for people.
std::string combinations_help();

}  // namespace shadewright::shadow
