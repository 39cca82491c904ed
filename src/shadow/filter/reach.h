// How far the look-ups of a spec read around a receiver: what a map must hold beyond its receivers.
#pragma once

#include "shadewright/shadow/spec.h"

namespace shadewright::shadow {

struct FilterReach {
  double texels = 0;  ///< of the map, to each side
  double metres = 0;  ///< on the receiver, to each side, in addition
};

FilterReach filter_reach(const Spec& spec);

/// The same for one face of six: they overlap by at least 20 texels, since what is clipped at the very edge of a map is
/// less exact than elsewhere.
FilterReach of_face(const FilterReach& reach);

/// As much of it as a map of `resolution` texels an axis may give away: half of its width. What a wider filter reads
/// beyond is lost.
FilterReach within_map(const FilterReach& reach, uint32_t resolution);

/// The least resolution of a cascaded map that has room for receivers beside the filter's reach.
uint32_t least_cascade_resolution(const Spec& spec);

}  // namespace shadewright::shadow
