// Sixteen shadow rays, traced together.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <glm/glm.hpp>

#include "raytrace/ray_scene.h"
#include "raytrace/tiles.h"

namespace shadewright {

/// Lanes start inactive. A ray that Embree does not take (see ray_scene.h) stays so.
class OcclusionPacket {
 public:
  void set(uint32_t lane, const glm::vec3& origin, const glm::vec3& direction, float length) {
    if (!is_traceable(origin, direction) || !(length > 0)) return;
    rays_.org_x[lane] = origin.x;
    rays_.org_y[lane] = origin.y;
    rays_.org_z[lane] = origin.z;
    rays_.dir_x[lane] = direction.x;
    rays_.dir_y[lane] = direction.y;
    rays_.dir_z[lane] = direction.z;
    rays_.tnear[lane] = 0;
    rays_.tfar[lane] = length;
    rays_.time[lane] = 0;
    rays_.mask[lane] = ~0u;
    rays_.id[lane] = lane;
    rays_.flags[lane] = 0;
    active_[lane] = -1;
    any_ = true;
  }

  /// Traces the active lanes; `free` answers afterwards.
  void trace(const RayScene& scene) {
    if (!any_) return;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    // Embree 3.13's coherent traversal of many instances was seen to loop forever on a packet of scattered rays.
    context.flags = scene.instanced() ? RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT : RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded16(active_, scene.get(), &context, &rays_);
  }

  bool active(uint32_t lane) const { return active_[lane] != 0; }
  /// True when nothing lies on the active lane's ray: Embree marks occlusion by a negative length.
  bool free(uint32_t lane) const { return rays_.tfar[lane] >= 0; }

 private:
  RTCRay16 rays_{};  // inactive lanes hold zeros, not whatever the stack held
  alignas(64) int active_[packet_size] = {};
  bool any_ = false;
};

}  // namespace shadewright
