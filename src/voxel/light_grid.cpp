#include "shadewright/voxel/light_grid.h"

#include <algorithm>
#include <cmath>

namespace shadewright::voxel {

namespace {
/// Snapping moves a vertex by up to 1/512 texel, and a plane by as much; float positions of far points take the rest.
constexpr double kSlack = 1.0 / 32;
constexpr double kGrazing = 0.1;  ///< the cosine below which a distant receiver moves no farther

double facing(const glm::dvec3& normal, const glm::dvec3& towards_light) {
  return std::max(std::abs(glm::dot(normal, towards_light)), kGrazing);
}
}  // namespace

glm::dvec3 LightGrid::position() const {
  // There x, y and w are all zero.
  const auto row = [&](int r) {
    return glm::dvec3(voxel_from_world[0][r], voxel_from_world[1][r], voxel_from_world[2][r]);
  };
  const glm::dmat3 rows = glm::transpose(glm::dmat3(row(0), row(1), row(3)));
  return glm::inverse(rows) * -glm::dvec3(voxel_from_world[3][0], voxel_from_world[3][1], voxel_from_world[3][3]);
}

double LightGrid::depth_at_unit_distance() const {
  return kind == LightKind::spot ? (far - near) / (far * near) / depth() : voxel_depth;
}

glm::dvec3 LightGrid::voxel(const glm::dvec3& world) const {
  const glm::dvec4 point = voxel_from_world * glm::dvec4(world, 1.0);
  return glm::dvec3(point) / point.w;
}

glm::dvec3 LightGrid::voxel_extent(const glm::dvec3& world) const {
  if (kind == LightKind::directional) return {texel_size.x, texel_size.y, voxel_depth};
  // z = far (w - near) / ((far - near) w), hence dw/dz = w² (far - near) / (far near).
  const double w = (voxel_from_world * glm::dvec4(world, 1.0)).w;
  return {texel_size.x * w, texel_size.y * w, w * w * depth_at_unit_distance()};
}

double LightGrid::receiver_offset(const glm::dvec3& world, const glm::dvec3& normal, uint32_t taps) const {
  const glm::dvec3 extent = voxel_extent(world);
  const glm::dvec3 n = glm::abs(light_from_world * normal);
  if (n.x + n.y + n.z == 0) return (0.5 + kSlack) * extent.z;
  return (0.5 * taps + kSlack) * (extent.x * n.x + extent.y * n.y) + (0.5 + kSlack) * extent.z * n.z;
}

glm::dvec3 LightGrid::receiver_voxel(const glm::dvec3& world, const glm::dvec3& normal, uint32_t taps) const {
  const bool unknown = normal == glm::dvec3(0.0);
  return voxel(world + (unknown ? -direction() : normal) * receiver_offset(world, normal, taps));
}

glm::dvec3 LightGrid::towards_light(const glm::dvec3& world) const {
  return kind == LightKind::spot ? glm::normalize(position() - world) : -direction();
}

glm::dvec2 LightGrid::plane_slope(const glm::dvec3& world, const glm::dvec3& normal) const {
  const glm::dvec3 extent = voxel_extent(world), n = light_from_world * normal;
  return glm::dvec2(n) * glm::dvec2(extent) / (facing(normal, towards_light(world)) * extent.z);
}

glm::ivec3 LightGrid::clear_node(const glm::dvec3& at, const glm::dvec2& slope, uint32_t height) {
  const glm::ivec3 node = glm::ivec3(glm::floor(at)) >> static_cast<int>(height);
  const glm::dvec2 low = glm::dvec2(node << static_cast<int>(height)) - glm::dvec2(at);
  const glm::dvec2 rise = glm::min(slope * low, slope * (low + std::exp2(height)));
  const int nearest = static_cast<int>(std::floor(at.z + rise.x + rise.y - (0.5 + kSlack)));
  return {node.x, node.y, (nearest >> height) - 1};
}

glm::dvec3 LightGrid::distant_receiver(const glm::dvec3& world, const glm::dvec3& normal, double half_width) const {
  const glm::dvec3 extent = voxel_extent(world), n = glm::abs(light_from_world * normal), light = towards_light(world);
  const double across = (half_width + kSlack) * (extent.x * n.x + extent.y * n.y);
  return world + light * (across / facing(normal, light));
}

LightGrid LightGrid::moved(const glm::dvec3& by) const {
  LightGrid result = *this;
  result.voxel_from_world[3] -= voxel_from_world * glm::dvec4(by, 0.0);
  return result;
}

LightGrid LightGrid::halved() const {
  LightGrid half = *this;
  --half.log2_size;
  --half.log2_depth;
  glm::dmat4 scale(0.5);
  scale[3][3] = 1;
  half.voxel_from_world = scale * voxel_from_world;
  half.texel_size *= 2.0;
  half.voxel_depth *= 2.0;
  return half;
}

}  // namespace shadewright::voxel
