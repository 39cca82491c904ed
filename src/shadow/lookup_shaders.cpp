#include "shadow/lookup_shaders.h"

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
std::span<const uint32_t> casters_shader(std::string_view combination) {
  return find(shaders::casters, combination);
}

}  // namespace shadewright::shadow
