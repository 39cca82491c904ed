#include "shadewright/compare/approximation.h"

#include "shadewright/compare/metrics.h"
#include "shadewright/error.h"

namespace shadewright::compare {

ApproximationError approximation_error(std::span<const SurfacePoint> exact, std::span<const uint8_t> exact_visible,
                                       std::span<const SurfacePoint> shown, std::span<const float> shown_visible,
                                       const Light& light) {
  if (exact_visible.size() != exact.size() || shown.size() != exact.size() || shown_visible.size() != exact.size())
    throw InputError("images", "they are not all of one size", "compare the same view");
  const std::vector<uint8_t> exact_facing = facing_light(exact, light), shown_facing = facing_light(shown, light);
  ApproximationError error;
  uint64_t shown_compared = 0, exact_lit = 0, shown_lit = 0;
  for (size_t i = 0; i < exact.size(); ++i) {
    const bool is_exact_lit = exact_facing[i] != 0 && exact_visible[i] != 0;
    const bool is_shown_lit = shown_facing[i] != 0 && lit(shown_visible[i]);
    error.compared += exact_facing[i];
    shown_compared += shown_facing[i];
    exact_lit += is_exact_lit;
    shown_lit += is_shown_lit;
    error.wrong += exact_facing[i] != 0 && is_exact_lit != is_shown_lit;
    error.coverage += exact[i].valid() != shown[i].valid();
  }
  const auto share = [](uint64_t part, uint64_t whole) {
    return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
  };
  error.fraction = share(error.wrong, error.compared);
  error.lit_exact = share(exact_lit, error.compared);
  error.lit_shown = share(shown_lit, shown_compared);
  return error;
}

}  // namespace shadewright::compare
