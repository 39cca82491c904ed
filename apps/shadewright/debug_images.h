// The flag --debug: pictures of how a technique works.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "shadewright/gpu/device.h"
#include "shadewright/shadow/spec.h"

namespace shadewright::app {

/// True if the names of the images are asked for, not images.
bool asks_for_list(std::span<const std::string> debug);
/// Names of the debug images that a technique has.
std::vector<std::string> debug_names(const gpu::Device& device, const shadow::Spec& spec);
/// InputError where a name in `debug` is no image of any of the techniques.
void check_debug(const gpu::Device& device, std::span<const shadow::Spec> specs, std::span<const std::string> debug);

}  // namespace shadewright::app
