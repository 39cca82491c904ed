#include "raytrace/light_ray.h"
#include "raytrace/occlusion_packet.h"
#include "raytrace/queries.h"

namespace shadewright {

std::vector<uint8_t> visible(const RayScene& scene, std::span<const SurfacePoint> points, const glm::vec3& eye,
                             const Light& light, uint32_t row_length) {
  std::vector<uint8_t> result(points.size(), 0);
  const LightRay ray(light);
  for_each_packet(Tiling(points.size(), row_length), [&](const PacketIndices& indices) {
    OcclusionPacket packet;
    for (uint32_t lane = 0; lane < indices.count; ++lane) {
      const SurfacePoint& point = points[indices.index[lane]];
      if (!point.valid() || !ray.reaches(point.position, point.normal)) continue;
      const glm::vec3 origin = point.position + point.normal * position_error(point.position, eye);
      packet.set(lane, origin, glm::vec3(ray.towards(origin)), ray.length());
    }
    packet.trace(scene);
    for (uint32_t lane = 0; lane < indices.count; ++lane)
      result[indices.index[lane]] = packet.active(lane) && packet.free(lane);
  });
  return result;
}

std::vector<uint8_t> unoccluded(const RayScene& scene, std::span<const Segment> segments, uint32_t row_length) {
  std::vector<uint8_t> result(segments.size(), 1);
  for_each_packet(Tiling(segments.size(), row_length), [&](const PacketIndices& indices) {
    OcclusionPacket packet;
    for (uint32_t lane = 0; lane < indices.count; ++lane) {
      const Segment& segment = segments[indices.index[lane]];
      if (segment.active != 0) packet.set(lane, segment.origin, segment.direction, segment.length);
    }
    packet.trace(scene);
    for (uint32_t lane = 0; lane < indices.count; ++lane)
      result[indices.index[lane]] = !packet.active(lane) || packet.free(lane);
  });
  return result;
}

}  // namespace shadewright
