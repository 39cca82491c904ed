// Fits a light's matrix to what receives: shared by the parameterizations that start from the light's own view.
#pragma once

#include <vector>

#include "shadewright/geometry/box.h"
#include "shadewright/geometry/polytope.h"
#include "shadewright/shadow/technique.h"
#include "shadow/filter/reach.h"

namespace shadewright::shadow {

/// Receivers' bounds are exact up to float rounding of the map coordinates.
inline constexpr double rounding_border_texels = 1;
/// A warped texel on what the camera sees is seldom so many times as wide as a uniform map's.
inline constexpr double widest_texel = 4;
/// What float surface points are off by, as a share of their coordinates and distance, with room.
inline constexpr double position_slack = 4e-6;

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

/// How much wider a map gets, all of it, for a border of so many texels.
double widening(double border_texels, uint32_t resolution);

/// What look-ups read beyond receivers at `distance` along the axis, as the light sees it: metres, or of a perspective
/// light a tangent, at most as wide again as its window.
double seen_reach(const LightFrame& light, double distance, double metres);

/// Half the size of a window that holds `receivers` (as `receiver_bounds` gives them) and what look-ups read around.
glm::dvec2 window_half(const LightFrame& light, const Box& receivers, uint32_t resolution, const FilterReach& reach);

/// How far from a receiver look-ups read at most: metres, and metres a metre of its view depth.
struct WorldReach {
  double metres = 0, per_depth = 0;
};

/// How far from a receiver look-ups read at most in a map so fitted.
WorldReach reach_on_receivers(const LightFrame& light, const Box& receivers, uint32_t resolution,
                              const FilterReach& reach);

/// The view whose map is `window`: bounds as `receiver_bounds` gives them.
MapView view_of_window(const LightFrame& light, const Box& window, uint32_t resolution);

/// The view whose map, `resolution` texels an axis, just holds `receivers` and what look-ups read around.
MapView fit_view(const LightFrame& light, const Box& receivers, uint32_t resolution, const FilterReach& reach);

/// The half-spaces that hold every caster for `view`: those of its matrix but the near one, and those of the camera,
/// `reach` outwards, that a way from there to the light never leaves.
std::vector<Plane> caster_planes(const MapView& view, const render::CameraView& camera, const Light& light,
                                 bool receivers_in_camera, const WorldReach& reach);

}  // namespace shadewright::shadow
