// shadewright devices: what it can run on, and which one it picks.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "shadewright/gpu/device.h"
#include "verbs.h"

namespace shadewright::app {

void add_devices(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("devices", "List the Vulkan devices, and which one is picked");
  verb->footer("Example: shadewright devices");
  verb->callback([] {
    const uint32_t picked = gpu::Device().info().index;
    for (const gpu::DeviceInfo& info : gpu::Device::list())
      fmt::print("{} {} {} ({}, {}){}\n", info.index == picked ? "*" : " ", info.index, info.name,
                 gpu::to_string(info.type), info.driver, info.unusable.empty() ? "" : ": " + info.unusable);
  });
}

}  // namespace shadewright::app
