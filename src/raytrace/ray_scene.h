// A Scene at one time as Embree holds it. Small scenes are flattened into one world space, with the same float
// arithmetic a GPU's vertex shader uses, so that both see the same triangles bit for bit (up to fused multiply-adds);
// large ones share their meshes by Embree's instancing, whose rays go to mesh space instead.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <type_traits>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright {

struct RtcRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
  void operator()(RTCBuffer buffer) const { rtcReleaseBuffer(buffer); }
};
template <typename Handle>
using RtcPtr = std::unique_ptr<std::remove_pointer_t<Handle>, RtcRelease>;

/// The triangles of one Embree geometry: buffers that Embree owns.
struct RayTriangles {
  const glm::vec3* positions = nullptr;
  const glm::uvec3* triangles = nullptr;

  std::array<glm::vec3, 3> corners(uint32_t triangle) const {
    const glm::uvec3& corner = triangles[triangle];
    return {positions[corner.x], positions[corner.y], positions[corner.z]};
  }
};

/// Whether Embree traces such a ray: it wants numbers below 1.8e18.
inline bool is_traceable(const glm::vec3& origin, const glm::vec3& direction) {
  const glm::vec3 sum = glm::abs(origin) + glm::abs(direction);
  return sum.x + sum.y + sum.z < 1e18f;  // not for what is not a number
}

class RayScene {
 public:
  /// Scenes of more triangles than this are instanced instead of flattened: 4 million take about 1 GB flattened.
  static constexpr size_t flatten_limit_default = 4'000'000;

  RayScene(const Scene& scene, double time, size_t flatten_limit = flatten_limit_default);

  /// Moves the instances to `time` of `scene`, the one this was made of.
  void update(const Scene& scene, double time);

  /// Geometry ids (flattened) or instance ids (instanced) are indices into Scene::instances, primitive ids into
  /// Mesh::triangles.
  RTCScene get() const { return scene_.get(); }
  bool instanced() const { return instanced_; }

  /// World positions of a triangle's corners, the same floats whether flattened or instanced.
  std::array<glm::vec3, 3> world_triangle(uint32_t instance, uint32_t triangle) const {
    const Placed& placed = placed_[instance];
    std::array<glm::vec3, 3> corners = geometries_[placed.geometry].corners(triangle);
    if (instanced_)
      for (glm::vec3& corner : corners) corner = to_world(placed.world_from_mesh, corner);
    return corners;
  }

 private:
  struct Placed {
    size_t geometry = 0;  ///< index into geometries_
    glm::mat4 world_from_mesh{1.0f};
  };
  // As a vertex shader does it: float matrix times float position.
  static glm::vec3 to_world(const glm::mat4& world_from_mesh, const glm::vec3& p) {
    return glm::vec3(world_from_mesh * glm::vec4(p, 1.0f));
  }
  void add_flattened(const Scene& scene);
  void add_instanced(const Scene& scene);

  RtcPtr<RTCDevice> device_;
  RtcPtr<RTCScene> scene_;
  std::vector<RayTriangles> geometries_;  ///< by instance when flattened, by mesh when instanced
  std::vector<Placed> placed_;            ///< by instance
  bool instanced_;
};

}  // namespace shadewright
