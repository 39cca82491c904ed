#include "shadow/filter/reach.h"

#include <algorithm>
#include <cmath>

namespace shadewright::shadow {

FilterReach filter_reach(const Spec& spec) {
  // Sub-pixel look-ups and ray tests read the texels around.
  if (spec.storage == "subpixel") return {1, 0};
  if (spec.storage == "triangle") return {spec.choice("kernel") == "5" ? 2.0 : 1.0, 0};
  if (spec.filter != "pcf") return {};
  // Blurred texels are blended between neighbours.
  if (spec.storage == "moments") return {spec.number("blur") + 1, 0};
  // Taps are read in pairs, whose second may lie a texel outside the box.
  if (spec.number("width") > 0) return {2, 0.5 * spec.number("width")};
  return {spec.number("radius") + 1.5, 0};
}

uint32_t least_cascade_resolution(const Spec& spec) {
  // To each side a texel for rounding, and half of one where the window moves by whole texels; and one for receivers.
  const double border = filter_reach(spec).texels + (spec.choice("stable") == "1" ? 1.5 : 1.0);
  return static_cast<uint32_t>(std::ceil(2 * border)) + 1;
}

FilterReach of_face(const FilterReach& reach) {
  return {std::max(reach.texels, 20.0), reach.metres};
}

FilterReach within_map(const FilterReach& reach, uint32_t resolution) {
  return {std::min(reach.texels, 0.25 * resolution - 1), reach.metres};
}

}  // namespace shadewright::shadow
