// The truth: visibility of the light from surface points, and what a camera sees, by Embree.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shadewright/scene/scene.h"

namespace shadewright {

/// A point of a surface, in world space relative to Scene::origin. `normal` is the geometric normal (unit, flipped
/// towards the camera); a zero normal marks "nothing here".
struct SurfacePoint {
  glm::vec3 position{0.0f};
  glm::vec3 normal{0.0f};

  bool valid() const { return normal.x != 0 || normal.y != 0 || normal.z != 0; }
};

/// A line of sight, in world space: occluded when geometry lies at origin + t * direction for some t in (0, length).
struct Segment {
  glm::vec3 origin{0.0f};
  float length = 0;  ///< in units of |direction|; infinity for a directional light
  glm::vec3 direction{0.0f};
  uint32_t active = 0;  ///< 0 = skip
};

/// What a primary ray hit.
struct PrimaryHit {
  float distance = 0;  ///< along the camera's axis (view depth), metres; 0 = background
  uint32_t instance = ~0u;
  uint32_t triangle = ~0u;  ///< index into Mesh::triangles
  glm::vec3 normal{0.0f};   ///< geometric, unit, flipped towards the camera; zero = background
};

/// How image pixels map to world: pixel (x, y)'s centre is at (x + 0.5, y + 0.5), y down.
struct PixelGrid {
  uint32_t width = 0, height = 0;
  Camera camera;
  /// World-space direction through image position (x, y) in pixels, scaled so that its view depth is 1.
  glm::dvec3 ray(double x, double y) const;
};

/// Embree's view of a scene at one time. Thread-safe once built; all calls use every core (oneTBB).
class Tracer {
 public:
  explicit Tracer(const Scene& scene, double time = 0);
  ~Tracer();
  Tracer(Tracer&&) noexcept;
  Tracer& operator=(Tracer&&) noexcept;

  /// Moves to another time of `scene`, the one this was made of: only instances whose motion has moved them are
  /// transformed again, and nothing is done if there are none. Answers are those of a Tracer made at that time. No
  /// query may run meanwhile.
  void update(const Scene& scene, double time);

  /// For each point 1 where the light reaches it, else 0. Points that are invalid, face away from the light, or lie
  /// outside a spot's cone get 0. `row_length` is the image's width if the points are an image (packets are then made
  /// of tiles), or 0. Rays start off the surface by `position_error` of the point, along the normal (no scene
  /// constant); `eye` is the camera that the points were seen from.
  std::vector<uint8_t> visible(std::span<const SurfacePoint> points, const glm::vec3& eye, const Light& light,
                               uint32_t row_length = 0) const;

  /// As `visible`, but the mean over `samples` positions in each pixel's footprint on the point's tangent plane
  /// (stratified, the same every run). `points` is the image of `grid`, row by row.
  std::vector<float> visible_supersampled(std::span<const SurfacePoint> points, const PixelGrid& grid,
                                          const Light& light, uint32_t samples) const;

  /// For each segment 1 where it is free, else 0 (inactive: 1). No offset is applied: the caller owns the tolerance.
  std::vector<uint8_t> unoccluded(std::span<const Segment> segments, uint32_t row_length = 0) const;

  /// First hits through the pixels' centres, row by row, beyond the camera's near distance.
  std::vector<PrimaryHit> primary(const PixelGrid& grid, double near) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Bound of the distance between a float surface point (a camera pass's) and its true plane: eye at `eye`, metres.
/// Derived from the float arithmetic of interpolating 1/w over the screen and of world coordinates; used by the
/// reference's ray offset and by every technique's bias (architecture, section 4).
float position_error(const glm::vec3& position, const glm::vec3& eye);

}  // namespace shadewright
