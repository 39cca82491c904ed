#include "shadewright/shadow/technique.h"

#include <fmt/ranges.h>

#include "shadewright/error.h"
#include "shadow/map_technique.h"
#include "shadow/parts.h"
#include "shadow/precomputed/precomputed.h"

namespace shadewright::shadow {

void Technique::record(const Frame& frame, VkCommandBuffer commands) {
  gpu::Recorder recorder(device_, commands);
  record(frame, recorder);
}

Picture Technique::debug_picture(std::string_view name) {
  throw InputError(fmt::format("--debug {}", name), "this technique has no debug image of that name",
                   fmt::format("its debug images: {}", fmt::join(debug_names(), ", ")));
}

bool serves(const Spec& spec, LightKind light) {
  return serves(spec.parameterization, light);
}

void check(const Spec& spec, const Scene& scene, const Light& light) {
  if (spec.parameterization == "ray") return;
  check_light(spec.parameterization, light.kind);
  if (spec.parameterization == "precomputed" && !spec.choice("file").empty()) open_baked(spec, &scene, light);
}

std::unique_ptr<Technique> make_technique(const gpu::Device& device, const Spec& spec,
                                          const TechniqueOptions& options) {
  if (options.width == 0 || options.height == 0 || options.frames_in_flight == 0)
    throw InputError("technique options", "width, height and frames in flight must be positive",
                     "give the camera's size");
  if (spec.parameterization == "ray")
    throw InputError(spec.text, "the ray-traced reference is not drawn on the device", "use shadewright::Tracer");
  if (spec.parameterization == "precomputed") return std::make_unique<Precomputed>(device, spec, options);
  return std::make_unique<MapTechnique>(device, spec, options);
}

}  // namespace shadewright::shadow
