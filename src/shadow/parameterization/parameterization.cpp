#include "shadow/parameterization/parameterization.h"

#include <fmt/format.h>

#include <stdexcept>

#include "shadewright/error.h"
#include "shadow/parameterization/cascaded/cascaded.h"
#include "shadow/parameterization/paged/paged.h"
#include "shadow/parameterization/perspective/perspective.h"
#include "shadow/parameterization/rectilinear/rectilinear.h"
#include "shadow/parameterization/uniform/uniform.h"
#include "shadow/view_caster_draws.h"

namespace shadewright::shadow {

std::unique_ptr<CasterDraws> Parameterization::make_caster_draws(LightKind light, uint32_t frames_in_flight) {
  return std::make_unique<ViewCasterDraws>(map_extent(light).layers, frames_in_flight);
}

std::unique_ptr<Parameterization> make_parameterization(const gpu::Device& device, const Spec& spec,
                                                        const TechniqueOptions& options) {
  if (spec.parameterization == "uniform")
    return std::make_unique<Uniform>(device, spec.resolution, spec.choice("fit"),
                                     within_map(filter_reach(spec), spec.resolution));
  if (spec.parameterization == "cascaded") return std::make_unique<Cascaded>(device, spec, options.frames_in_flight);
  if (spec.parameterization == "perspective") {
    const std::string warp = spec.choice("warp");
    const WarpKind kind = warp == "psm" ? WarpKind::psm : warp == "lispsm" ? WarpKind::light_space : WarpKind::best;
    if (kind != WarpKind::psm && spec.choice("shift") == "least")
      throw InputError(fmt::format("spec '{}'", spec.text), "only plain perspective shadow maps shift the eye",
                       "add warp=psm or leave shift out");
    const PerspectiveOptions perspective{kind,
                                         spec.choice("shift") == "least",
                                         spec.choice("fit") == "visible",
                                         within_map(filter_reach(spec), spec.resolution),
                                         spec.filter == "pcf",
                                         spec.choice("fallback") == "on"};
    return std::make_unique<Perspective>(device, spec.resolution, perspective, options.width, options.height);
  }
  if (spec.parameterization == "paged") return std::make_unique<Paged>(device, spec, options);
  if (spec.parameterization == "rectilinear") return std::make_unique<Rectilinear>(device, spec, options);
  throw std::logic_error(fmt::format("parameterization '{}' has shaders but no class", spec.parameterization));
}

}  // namespace shadewright::shadow
