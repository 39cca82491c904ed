// Fits a light's matrix to what receives: shared by the parameterizations that start from the light's own view.
#pragma once

#include <vector>

#include "shadewright/geometry/box.h"
#include "shadewright/geometry/polytope.h"
#include "shadewright/shadow/technique.h"

namespace shadewright::shadow {

/// Axes to measure receivers in: light-space view coordinates, looking along -Z, world space to view space.
struct LightFrame {
  glm::dmat4 view_from_world{1.0};
  bool perspective = false;  ///< spot, or one face of a point light
  double max_tangent = 0;    ///< perspective: half width of the widest window, tangent
};

/// The light's frame before fitting: one, or six for a point light (+X -X +Y -Y +Z -Z).
std::vector<LightFrame> light_frames(const Light& light);

/// The half-spaces of the widest window of a perspective light, world space; none for a directional one.
std::vector<Plane> window_planes(const LightFrame& light);

/// World points whose convex hull holds all receivers: per instance, its bounds cut by `planes` (none = uncut).
std::vector<glm::dvec3> receiver_points(const Frame& frame, std::span<const Plane> planes);

/// Bounds of receivers as the light sees them. Directional: view coordinates. Perspective: x/-z, y/-z, and z as it is.
/// `points` of a perspective light are cut by its window planes. Empty for no points.
Box receiver_bounds(const LightFrame& light, std::span<const glm::dvec3> points);

/// (cosine, sine) of the turn, of 32 within a right angle, that gives `points` the bounding rectangle of least area.
glm::dvec2 smallest_turn(std::span<const glm::dvec2> points);

/// Turns a directional light's frame about its axis so that the receivers' bounding rectangle is smallest (of 32
/// angles). Others stay as they are.
LightFrame turn_to_fit(const LightFrame& light, std::span<const glm::dvec3> points);

/// The view whose map, `resolution` texels an axis, just holds `receivers` (as `receiver_bounds` gives them), with a
/// border of `border_texels`.
MapView fit_view(const LightFrame& light, const Box& receivers, uint32_t resolution, double border_texels);

/// The half-spaces that hold every caster for `view`: those of its matrix but the near one, and those of the camera
/// that a way from a receiver to the light never leaves.
std::vector<Plane> caster_planes(const MapView& view, const render::CameraView& camera, const Light& light,
                                 bool receivers_in_camera);

}  // namespace shadewright::shadow
