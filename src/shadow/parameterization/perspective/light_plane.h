// The receivers as the light sees them, in its own plane: every map of one matrix is a projection of that plane. How
// large its texels are on the receivers, and the projection that makes them smallest.
//
// A shadow's edge is displaced by the size of a texel, and wrong pixels are what it sweeps. How much of the edges each
// sample has around it is roughly known from casters' bounds, which way they run is not. Silhouettes are of any
// direction as the light sees them; but what small casters leave on the ground is so on the surface. The two differ
// where light grazes. A texel's size is therefore measured in both, the light's plane and the surface (the root of the
// sum of the squares of its sides), each as a share of the median of a uniform map's, and added. A shadow is not
// displaced by more than its own size, so sizes far above the median count less and less.
#pragma once

#include "shadow/parameterization/perspective/receivers.h"
#include "shadow/parameterization/uniform/fit.h"

namespace shadewright::shadow {

/// Image of a world point: (x / w, y / w), in any unit. Rows of the world.
struct Projection {
  glm::dvec4 x, y, w;
};

/// The light's own undistorted view.
Projection uniform_projection(const LightFrame& light);

class LightPlane {
 public:
  /// `corners` of the receivers' hull are in front of the light.
  LightPlane(const LightFrame& frame, const Light& light, std::span<const glm::dvec3> corners,
             std::span<const ReceiverSample> samples);

  /// False: no sample faces the light.
  bool measurable() const { return !x_.empty(); }
  /// Mean size of a map's texels as above, over the edges in what the camera sees, in units of those of a uniform map.
  double mean_texel(const glm::dmat4& light_from_world) const;
  /// Of all projections of the plane the one whose map, fitted to the receivers without turning, has the smallest
  /// texels, by search.
  Projection best_projection() const;

 private:
  /// A map's rows u, v, w over the plane's (x, y, 1).
  struct Rows {
    glm::dvec3 u, v, w;
  };
  struct Shape;
  Rows rows(const Shape& shape) const;
  /// By the first `count` samples.
  double mean_texel(const Rows& rows, size_t count) const;

  Projection plane_;                       ///< coordinates in which the hull is about [-1, 1]^2
  glm::dmat3x4 points_{0.0};               ///< world points at (0, 0), (1, 0), (0, 1) of the plane with w = 1
  std::vector<glm::dvec2> hull_;           ///< corners, in the plane
  mutable std::vector<double> inverse_w_;  ///< of the rows that are being made, there
  /// Of each sample that faces the light: where it is in the plane; how far steps of a metre along two axes of its own
  /// surface move it there, and the inverse of the determinant of those; how much of the shadows' edges is around it.
  std::vector<float> x_, y_, right_x_, right_y_, down_x_, down_y_, inverse_area_, edges_;
  float few_edges_ = 0, all_edges_ = 0;        ///< sums
  float plane_scale_ = 1, surface_scale_ = 1;  ///< the inverse of the medians of a uniform map's
  size_t few_ = 0;                             ///< so many first samples are spread over the image
};

}  // namespace shadewright::shadow
