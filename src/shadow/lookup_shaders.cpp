#include "shadow/lookup_shaders.h"

#include <fmt/format.h>

#include "shaders/lookup_table.h"

namespace shadewright::shadow {

namespace {

template <typename Table>
std::span<const uint32_t> find(const Table& table, std::string_view name) {
  for (const auto& [key, words] : table)
    if (key == name) return words;
  return {};
}

}  // namespace

std::span<const uint32_t> lookup_shader(std::string_view combination) {
  return find(shaders::lookups, combination);
}
std::span<const uint32_t> oracle_shader(std::string_view parameterization) {
  return find(shaders::oracles, parameterization);
}
std::span<const uint32_t> decisions_shader(std::string_view maps) {
  return find(shaders::decisions, maps);
}
gpu::GraphicsDesc casters_shaders(const Spec& spec) {
  const auto stage = [&](std::string_view name) {
    return find(shaders::casters, fmt::format("{}/{}.{}", spec.parameterization, spec.storage, name));
  };
  gpu::GraphicsDesc desc;
  desc.vertex = stage("vert");
  desc.tessellation_control = stage("tesc");
  desc.tessellation_evaluation = stage("tese");
  desc.geometry = stage("geom");
  desc.fragment = stage("frag");
  return desc;
}

std::span<const uint32_t> bent_fragment_shader(const Spec& spec) {
  return find(shaders::casters, fmt::format("{}/{}.bent", spec.parameterization, spec.storage));
}

}  // namespace shadewright::shadow
