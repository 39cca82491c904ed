#include "shadow/lookup_data.h"

#include <cmath>

namespace shadewright::shadow {

uint32_t shared_kind(LightKind kind) {
  switch (kind) {
    case LightKind::spot:
      return shared::light_spot;
    case LightKind::point:
      return shared::light_point;
    default:
      return shared::light_directional;
  }
}

bool same_light(const Light& a, const Light& b) {
  return a.kind == b.kind && a.direction == b.direction && a.position == b.position && a.outer_angle == b.outer_angle;
}

shared::LookupData lookup_data(const Frame& frame) {
  shared::LookupData lookup{};
  lookup.light_position = glm::vec3(frame.light.position);
  lookup.light_direction = glm::vec3(frame.light.direction);
  lookup.light_cos_outer = static_cast<float>(std::cos(frame.light.outer_angle));
  lookup.light_kind = shared_kind(frame.light.kind);
  lookup.eye = glm::vec3(frame.camera.eye());
  return lookup;
}

glm::dmat4 map_from_world(const MapView& view) {
  glm::dmat4 map_from_clip(1.0);
  map_from_clip[0][0] = map_from_clip[1][1] = 0.5;
  map_from_clip[3][0] = map_from_clip[3][1] = 0.5;
  return map_from_clip * view.light_from_world;
}

}  // namespace shadewright::shadow
