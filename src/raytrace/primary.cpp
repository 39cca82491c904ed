#include <limits>

#include "raytrace/pixel_rays.h"
#include "raytrace/queries.h"
#include "raytrace/tiles.h"

namespace shadewright {
namespace {

// The hit of `direction` (unit view depth) on a triangle that Embree chose, in double: Embree's own distance has a
// float error of the size of the triangle.
PrimaryHit settle(const RayScene& scene, uint32_t instance, uint32_t triangle, const glm::dvec3& eye,
                  const glm::dvec3& direction, float embree_distance) {
  const std::array<glm::vec3, 3> corners = scene.world_triangle(instance, triangle);
  const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
  const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
  const double cosine = glm::dot(normal, direction);
  const double distance = glm::dot(normal, a - eye) / cosine;
  return {.distance = distance > 0 ? static_cast<float>(distance) : embree_distance,  // false for a ray in the plane
          .instance = instance,
          .triangle = triangle,
          .normal = glm::vec3(cosine > 0 ? -normal : normal)};
}

}  // namespace

std::vector<PrimaryHit> primary(const RayScene& scene, const PixelGrid& grid, double near) {
  std::vector<PrimaryHit> result(size_t{grid.width} * grid.height);
  if (result.empty()) return result;
  const PixelRays rays(grid);
  const glm::vec3 eye(rays.eye);
  for_each_packet(Tiling(result.size(), grid.width), [&](const PacketIndices& indices) {
    const auto direction_of = [&](uint32_t lane) {
      const size_t pixel = indices.index[lane];
      return rays(static_cast<double>(pixel % grid.width) + 0.5, static_cast<double>(pixel / grid.width) + 0.5);
    };
    alignas(64) int active[packet_size] = {};
    RTCRayHit16 packet;
    for (uint32_t lane = 0; lane < indices.count; ++lane) {
      const glm::vec3 direction(direction_of(lane));
      packet.ray.org_x[lane] = eye.x;
      packet.ray.org_y[lane] = eye.y;
      packet.ray.org_z[lane] = eye.z;
      packet.ray.dir_x[lane] = direction.x;
      packet.ray.dir_y[lane] = direction.y;
      packet.ray.dir_z[lane] = direction.z;
      packet.ray.tnear[lane] = static_cast<float>(near);  // directions have unit view depth: distances are depths
      packet.ray.tfar[lane] = std::numeric_limits<float>::infinity();
      packet.ray.time[lane] = 0;
      packet.ray.mask[lane] = ~0u;
      packet.ray.id[lane] = lane;
      packet.ray.flags[lane] = 0;
      packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
      active[lane] = is_traceable(eye, direction) ? -1 : 0;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(active, scene.get(), &context, &packet);
    for (uint32_t lane = 0; lane < indices.count; ++lane) {
      if (packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
      const uint32_t instance = scene.instanced() ? packet.hit.instID[0][lane] : packet.hit.geomID[lane];
      result[indices.index[lane]] =
          settle(scene, instance, packet.hit.primID[lane], rays.eye, direction_of(lane), packet.ray.tfar[lane]);
    }
  });
  return result;
}

}  // namespace shadewright
