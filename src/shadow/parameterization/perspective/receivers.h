// What the camera sees that may receive shadows: found on the device as depth ranges of tiles, kept as points, their
// convex hull, and sampled surface points.
#pragma once

#include <span>
#include <vector>

#include "shadewright/geometry/polytope.h"
#include "shadewright/shadow/technique.h"
#include "shadow/parameterization/perspective/visible.h"

namespace shadewright::shadow {

/// The camera's perspective transform. Rows of a 4x4 matrix from the world: (x, y, w) is the image in normalized device
/// coordinates, w the view depth in metres.
struct CameraMap {
  glm::dvec4 x, y, w;

  explicit CameraMap(const render::CameraView& camera);
  glm::dvec3 forward() const { return glm::dvec3(w); }
  /// The whole transform: z runs from -1 at view depth `near` to 1 at `far`. `shift` is how far the eye is moved back.
  glm::dmat4 post_perspective(double near, double far, double shift) const;
};

/// A visible surface point.
struct ReceiverSample {
  glm::dvec3 world, normal;
  float edges = 1;  ///< how much of the shadows' edges is expected around it, in any unit
};

/// Where receivers are: bounds in post-perspective space and in the world.
struct ReceiverBox {
  Box post;
  glm::vec3 low, high;  ///< world
};

/// No boxes: nothing is visible.
struct Receivers {
  double nearest = 0, farthest = 0;  ///< view depths
  double light_distance = 0;         ///< no receiver is nearer to a light with a position, along its axis
  glm::dmat4 world_from_post{1.0};   ///< inverse of the camera's post_perspective(nearest, farthest, 0)
  std::vector<ReceiverBox> boxes;    ///< hold every receiver
  std::vector<ReceiverSample> samples;
  Polytope hull;                    ///< holds every receiver, few faces: once bound
  std::vector<glm::dvec3> corners;  ///< of the hull, each once
};

/// A grid of square tiles of an even side over an image: at most about 2,300.
struct TileGrid {
  uint32_t side, columns, rows;
};
TileGrid tile_grid(uint32_t width, uint32_t height);

/// Receivers that the camera sees, from its buffers: only what faces the light.
Receivers visible_receivers(const render::CameraView& camera, std::span<const shared::VisibleTile> tiles,
                            const TileGrid& grid);
/// Receivers that it may see, without its buffers: what its frustum holds of each instance's bounds. They are sampled
/// as if they faced the light.
Receivers bounded_receivers(const Frame& frame);

/// Boxes that reach inside all `planes` and samples there: for one face of a light.
Receivers inside(const Receivers& receivers, std::span<const Plane> planes);

/// Fits the hull to the part of the boxes inside all `planes`.
void bound(Receivers& receivers, std::span<const Plane> planes);

}  // namespace shadewright::shadow
