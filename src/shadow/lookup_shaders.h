// The compiled shaders of each legal combination, found by name. The table is generated with the shaders.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "shadewright/gpu/pass.h"
#include "shadewright/shadow/spec.h"

namespace shadewright::shadow {

/// "uniform/depth/hard" -> SPIR-V of its look-up; empty for a combination that is not built.
std::span<const uint32_t> lookup_shader(std::string_view combination);
/// "uniform" -> SPIR-V of the oracle's rays.
std::span<const uint32_t> oracle_shader(std::string_view parameterization);
/// "uniform/subpixel" -> SPIR-V of the debug picture "decisions"; empty for a storage that has none.
std::span<const uint32_t> decisions_shader(std::string_view maps);
/// The stages that draw casters for the spec's parameterization and storage: those of `storage/NAME/casters.STAGE.in`.
gpu::GraphicsDesc casters_shaders(const Spec& spec);
/// The fragment stage of casters whose edges bend in the map; empty where the parameterization bends none.
std::span<const uint32_t> bent_fragment_shader(const Spec& spec);

}  // namespace shadewright::shadow
