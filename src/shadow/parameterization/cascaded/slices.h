// Slices of a camera's view along its depth, one a cascade.
#pragma once

#include <vector>

#include "shadow/parameterization/uniform/fit.h"
#include "shadow/parameterization/visible_bounds.h"

namespace shadewright::shadow {

/// `count` adjoining slices of `range`. Their borders are lambda * logarithmic + (1 - lambda) * linear (Zhang et al.
/// 2006, equations 1 to 5). The range's nearest depth must be positive.
std::vector<DepthRange> split(const DepthRange& range, uint32_t count, double lambda);

/// The camera's depth at a point: its clip w, a distance along its axis.
double view_depth(const render::CameraView& camera, const glm::dvec3& world);
/// The view depths of `points`; nearest > farthest for none.
DepthRange view_depths(const render::CameraView& camera, std::span<const glm::dvec3> points);

/// The camera's half-spaces with those that bound a slice: none at 0, or at infinity.
std::vector<Plane> slice_planes(const render::CameraView& camera, const DepthRange& slice);

}  // namespace shadewright::shadow
