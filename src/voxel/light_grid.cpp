#include "shadewright/voxel/light_grid.h"

#include <cmath>

namespace shadewright::voxel {

namespace {
/// Snapping moves a vertex by up to 1/512 texel, and a plane by as much; float positions of far points take the rest.
constexpr double kSlack = 1.0 / 32;
}  // namespace

glm::dvec3 LightGrid::voxel(const glm::dvec3& world) const {
  const glm::dvec4 point = voxel_from_world * glm::dvec4(world, 1.0);
  return glm::dvec3(point) / point.w;
}

glm::dvec3 LightGrid::voxel_extent(const glm::dvec3& world) const {
  if (kind == LightKind::directional) return {texel_size.x, texel_size.y, voxel_depth};
  // z = far (w - near) / ((far - near) w), hence dw/dz = w² (far - near) / (far near).
  const double w = (voxel_from_world * glm::dvec4(world, 1.0)).w;
  return {texel_size.x * w, texel_size.y * w, w * w * (far - near) / (far * near) / double(depth())};
}

double LightGrid::receiver_offset(const glm::dvec3& world, const glm::dvec3& normal, uint32_t taps) const {
  const glm::dvec3 extent = voxel_extent(world);
  const glm::dvec3 n = glm::abs(light_from_world * normal);
  if (n.x + n.y + n.z == 0) return (0.5 + kSlack) * extent.z;
  return (0.5 * taps + kSlack) * (extent.x * n.x + extent.y * n.y) + (0.5 + kSlack) * extent.z * n.z;
}

glm::dvec3 LightGrid::receiver_voxel(const glm::dvec3& world, const glm::dvec3& normal, uint32_t taps) const {
  const bool unknown = normal == glm::dvec3(0.0);
  const glm::dvec3 towards_light = -glm::transpose(light_from_world)[2];
  return voxel(world + (unknown ? towards_light : normal) * receiver_offset(world, normal, taps));
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
