#include "debug_images.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "shadewright/error.h"
#include "shadewright/shadow/technique.h"

namespace shadewright::app {

bool asks_for_list(std::span<const std::string> debug) {
  return std::ranges::find(debug, "list") != debug.end();
}

std::vector<std::string> debug_names(const gpu::Device& device, const shadow::Spec& spec) {
  if (spec.parameterization == "ray") return {};
  const Scene no_scene;
  return shadow::make_technique(device, spec, {16, 16, 1, true, &no_scene})->debug_names();
}

void check_debug(const gpu::Device& device, std::span<const shadow::Spec> specs, std::span<const std::string> debug) {
  if (debug.empty()) return;
  std::set<std::string> known;
  for (const shadow::Spec& spec : specs)
    for (std::string& name : debug_names(device, spec)) known.insert(std::move(name));
  for (const std::string& name : debug)
    if (!known.contains(name))
      throw InputError("--debug " + name, "no technique that was given has a debug image of that name",
                       known.empty() ? "leave it out" : fmt::format("choose among {}", fmt::join(known, ", ")));
}

}  // namespace shadewright::app
