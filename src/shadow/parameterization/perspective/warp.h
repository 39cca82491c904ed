// The light's matrix as a projection of the plane that the light sees, chosen so that texels are small where the camera
// looks closely.
//
// Every shadow map of one matrix is a projection from the light's position (or direction): three rows x, y, w of the
// world that vanish at the light, and any depth that grows along its rays. So what the papers call inverted lights, or
// objects beyond the infinity plane, concerns the depth alone; here depth is always the light's own distance, and a
// caster is in front of the map (w > 0) exactly when the receivers behind it are.
#pragma once

#include <optional>

#include "shadow/parameterization/perspective/light_plane.h"

namespace shadewright::shadow {

/// (position, 1), or (direction towards the light, 0).
glm::dvec4 homogeneous_position(const Light& light);

/// PSM: the view from the light's image under the camera's perspective transform with the eye moved back by `shift`
/// (section 4.2) towards the middle of the receivers there. All cases of figures 4 and 5 in one formula.
Projection perspective_projection(const glm::dvec4& light, const CameraMap& camera, const Receivers& receivers,
                                  double shift);

/// Light space perspective shadow maps (Wimmer, Scherzer, Purgathofer 2004): a perspective across the light's direction
/// with their near distance n = (z_n + sqrt(z_n z_f)) / sin(gamma). The uniform projection where the view axis points
/// at the light.
Projection light_space_projection(const LightFrame& light, const CameraMap& camera, const Receivers& receivers);

/// The least shift that puts H, the hull of receivers and light within `scene` and the light's window, in front of the
/// camera by the near distance (section 4).
double least_shift(const Light& light, const LightFrame& frame, const CameraMap& camera, const Receivers& receivers,
                   const Box& scene);

/// light_from_world whose map just holds the receivers and what look-ups read around; none where `projection` does not
/// have all of them in front of it, or no receivers are there.
struct FitOptions {
  uint32_t resolution = 0;
  FilterReach reach{};
  bool turn = true;    ///< the map's axes to where its window is smallest; else they are the projection's
  bool exact = false;  ///< takes the receivers' boxes into account, not only their hull
};
std::optional<glm::dmat4> fit_projection(const Projection& projection, const LightFrame& light,
                                         const Receivers& receivers, const FitOptions& options);

enum class WarpKind { best, psm, light_space };

struct WarpOptions {
  WarpKind kind = WarpKind::best;
  bool least_shift = false;           ///< of PSM: as little as H allows; otherwise the best
  uint32_t resolution = 0;            ///< texels per axis
  bool seen = true;                   ///< receivers' samples are surface points, not corners of what bounds them
  const glm::dmat4* plain = nullptr;  ///< what uniform,fit=view draws; null: it draws nothing, or is not known
  std::span<const Box> casters;       ///< world bounds that hold all casters; none: not known
  FilterReach reach{};                ///< what look-ups read around a receiver
  bool soft = false;                  ///< what they read there darkens it
  bool falls_back = true;             ///< to a uniform map where that has smaller texels
};

/// The matrix of one view.
struct Warp {
  glm::dmat4 light_from_world{1.0};
  bool drawn = false;     ///< false: nothing visible receives here
  bool fallback = false;  ///< uniform, since no perspective will do, or has smaller texels
  double shift = 0;       ///< of PSM's eye, metres
  double gain = 1;        ///< mean size of a uniform map's texel over this one's
  WorldReach reach{};     ///< of look-ups around a receiver
};

/// The matrix of the view of `light` along `frame` (the light's only one, or a face's).
Warp choose_warp(const Light& light, const LightFrame& frame, const CameraMap& camera, const Receivers& receivers,
                 const Box& scene, const WarpOptions& options);

}  // namespace shadewright::shadow
