// What every look-up is told of the frame: the light and the eye.
#pragma once

#include "shadewright/shadow/technique.h"
#include "shadow/shared.h"

namespace shadewright::shadow {

/// True if nothing of what a shadow depends on differs.
bool same_light(const Light& a, const Light& b);

/// light_directional, light_spot or light_point.
uint32_t shared_kind(LightKind kind);

/// The members that follow from the frame; the map's are left as they are.
shared::LookupData lookup_data(const Frame& frame);

/// World to map space of a view: (u w, v w, depth w, w).
glm::dmat4 map_from_world(const MapView& view);

}  // namespace shadewright::shadow
