// Convex polytopes as lists of faces, clipped by half-spaces: what a camera sees of a box, what a light must cover.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "shadewright/geometry/box.h"

namespace shadewright {

/// Half-space: a point p is inside when dot(normal, p) + offset >= 0. `normal` has unit length and points inside.
struct Plane {
  glm::dvec3 normal{0, 1, 0};
  double offset = 0;

  double distance(const glm::dvec3& p) const { return glm::dot(normal, p) + offset; }
};

/// A closed convex polytope; empty when it has no faces. Faces wind counter-clockwise seen from outside.
struct Polytope {
  struct Face {
    Plane plane;
    std::vector<glm::dvec3> polygon;
  };
  std::vector<Face> faces;

  bool empty() const { return faces.empty(); }
  /// All corners of all faces (each as often as faces meet there).
  std::vector<glm::dvec3> points() const;
  /// The bounding half-spaces.
  std::vector<Plane> planes() const;
  Box bounds() const;

  static Polytope from_box(const Box& box);
};

/// The part of `polytope` inside `plane`. Slivers below 1e-12 of the polytope's size are dropped; one that is flat and
/// lies in the plane stays whole.
Polytope clip(Polytope polytope, const Plane& plane);
/// The part of `polytope` inside all `planes`.
Polytope clip(Polytope polytope, std::span<const Plane> planes);

/// `polytope` under a projective map whose w is positive on all of it. Faces keep their order; their planes are fitted
/// to the mapped corners.
Polytope transform(const glm::dmat4& to_from, const Polytope& polytope);

/// Half-spaces whose intersection is the convex hull of `polytope` and a point: (position, 1), or (direction, 0) for a
/// point at infinity. Where the point lies in the plane of a face or on the line of an edge, a half-space may be left
/// out: the result is never too small. None for an empty polytope.
std::vector<Plane> hull_planes(const Polytope& polytope, const glm::dvec4& point);

/// The half-spaces of a Vulkan clip volume (-w <= x, y <= w, 0 <= z <= w) in the space that `clip_from_space` maps
/// from. Planes at infinity (an infinite far plane) are left out. Order: left, right, top, bottom, z >= 0, z <= w.
std::vector<Plane> frustum_planes(const glm::dmat4& clip_from_space);

/// True when `box` lies entirely outside one of `planes` (conservative: false for some boxes that miss the
/// intersection).
bool outside(const Box& box, std::span<const Plane> planes);

}  // namespace shadewright
