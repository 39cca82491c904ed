// Clipping convex polytopes. Each face is clipped as by Sutherland and Hodgman ("Reentrant Polygon Clipping", 1974);
// the cut is closed by sorting the new corners around their centre, which a convex cut allows.
#include "shadewright/geometry/polytope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/place_order.h"
#include "shadewright/geometry/projection.h"

namespace shadewright {
namespace {

enum class Side { outside, on, inside };

/// Distances below this are zero: 1e-12 of the polytope's size, and never finer than what doubles resolve there.
double tolerance(const Box& box, const Plane& plane) {
  const glm::dvec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
  const double magnitude = glm::dot(glm::abs(plane.normal), reach) + std::abs(plane.offset);
  return std::max(1e-12 * box.diagonal(), 8 * std::numeric_limits<double>::epsilon() * magnitude);
}

Side side_of(double distance, double epsilon) {
  return distance > epsilon ? Side::inside : distance < -epsilon ? Side::outside : Side::on;
}

/// Always walks from the inner to the outer end, so that the two faces which share an edge get the same bits.
glm::dvec3 cut_edge(const glm::dvec3& inner, double inner_distance, const glm::dvec3& outer, double outer_distance) {
  return inner + (outer - inner) * (inner_distance / (inner_distance - outer_distance));
}

glm::dvec3 mean(const std::vector<glm::dvec3>& points) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// Grows with the angle of (x, y) from 0 to 4.
double turn(double x, double y) {
  const double length = std::abs(x) + std::abs(y);
  if (!(length > 0)) return 0;
  return y >= 0 ? 1 - x / length : 3 + x / length;
}

/// Clips a polytope by planes, one after another. What one cut needs to remember serves the next.
class Clipper {
 public:
  explicit Clipper(Polytope& polytope) : polytope_(polytope) {}

  void clip(const Plane& plane) {
    distances_.clear();
    Box bounds;
    for (const Polytope::Face& face : polytope_.faces)
      for (const glm::dvec3& p : face.polygon) {
        bounds.extend(p);
        distances_.push_back(plane.distance(p));
      }
    const double epsilon = tolerance(bounds, plane);
    bool any_inside = false, any_outside = false;
    for (const double distance : distances_) {
      any_inside |= side_of(distance, epsilon) == Side::inside;
      any_outside |= side_of(distance, epsilon) == Side::outside;
    }
    // A flat polytope that lies in the plane is inside.
    if (any_outside && !any_inside) polytope_.faces.clear();
    if (!any_inside || !any_outside) return;

    cut_.clear();
    const double* distances = distances_.data();
    size_t kept = 0;
    for (Polytope::Face& face : polytope_.faces) {
      const size_t corners = face.polygon.size();
      if (clip_polygon(face.polygon, distances, epsilon)) std::swap(polytope_.faces[kept++], face);
      distances += corners;
    }
    close_cut(plane);
    if (cut_.size() < 3) {
      polytope_.faces.resize(kept);
      return;
    }
    polytope_.faces.resize(kept + 1);
    polytope_.faces.back().plane = plane;
    polytope_.faces.back().polygon.assign(cut_.begin(), cut_.end());
  }

 private:
  /// Leaves the part of a face inside; corners on the plane are appended to the cut. False if nothing is left.
  bool clip_polygon(std::vector<glm::dvec3>& polygon, const double* distances, double epsilon) {
    kept_.clear();
    bool any_inside = false, any_outside = false;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const size_t next = i + 1 == polygon.size() ? 0 : i + 1;
      const glm::dvec3 &a = polygon[i], &b = polygon[next];
      const double distance_a = distances[i], distance_b = distances[next];
      const Side side_a = side_of(distance_a, epsilon), side_b = side_of(distance_b, epsilon);
      any_inside |= side_a == Side::inside;
      any_outside |= side_a == Side::outside;
      if (side_a != Side::outside) kept_.push_back(a);
      if (side_a == Side::on) cut_.push_back(a);
      const bool crosses =
          (side_a == Side::inside && side_b == Side::outside) || (side_a == Side::outside && side_b == Side::inside);
      if (!crosses) continue;
      kept_.push_back(side_a == Side::inside ? cut_edge(a, distance_a, b, distance_b)
                                             : cut_edge(b, distance_b, a, distance_a));
      cut_.push_back(kept_.back());
    }
    if (any_outside) std::swap(polygon, kept_);
    return any_inside && polygon.size() >= 3;
  }

  /// Makes the cut's corners the convex polygon through them, counter-clockwise seen from outside (against the plane's
  /// normal).
  void close_cut(const Plane& plane) {
    sort_distinct(cut_);
    if (cut_.size() < 3) return;
    const glm::dvec3 center = mean(cut_);
    glm::dvec3 u, v;
    perpendicular_axes(-plane.normal, u, v);
    turns_.clear();
    for (const glm::dvec3& p : cut_) turns_.push_back({turn(glm::dot(p - center, u), glm::dot(p - center, v)), p});
    std::sort(turns_.begin(), turns_.end(), [&](const Turn& a, const Turn& b) {
      return a.angle != b.angle ? a.angle < b.angle : comes_before(a.corner, b.corner);
    });
    for (size_t i = 0; i < cut_.size(); ++i) cut_[i] = turns_[i].corner;
  }

  struct Turn {
    double angle;
    glm::dvec3 corner;
  };
  Polytope& polytope_;
  std::vector<double> distances_;  ///< of all corners of all faces from the plane
  std::vector<glm::dvec3> kept_, cut_;
  std::vector<Turn> turns_;
};

}  // namespace

std::vector<glm::dvec3> Polytope::points() const {
  std::vector<glm::dvec3> result;
  for (const Face& face : faces) result.insert(result.end(), face.polygon.begin(), face.polygon.end());
  return result;
}

std::vector<Plane> Polytope::planes() const {
  std::vector<Plane> result;
  for (const Face& face : faces) result.push_back(face.plane);
  return result;
}

Box Polytope::bounds() const {
  Box box;
  for (const Face& face : faces)
    for (const glm::dvec3& p : face.polygon) box.extend(p);
  return box;
}

Polytope Polytope::from_box(const Box& box) {
  if (box.empty()) return {};
  const std::array<glm::dvec3, 8> c = box.corners();
  Polytope result;
  result.faces = {
      {{{1, 0, 0}, -box.min.x}, {c[0], c[4], c[6], c[2]}}, {{{-1, 0, 0}, box.max.x}, {c[1], c[3], c[7], c[5]}},
      {{{0, 1, 0}, -box.min.y}, {c[0], c[1], c[5], c[4]}}, {{{0, -1, 0}, box.max.y}, {c[2], c[6], c[7], c[3]}},
      {{{0, 0, 1}, -box.min.z}, {c[0], c[2], c[3], c[1]}}, {{{0, 0, -1}, box.max.z}, {c[4], c[5], c[7], c[6]}},
  };
  return result;
}

Polytope clip(Polytope polytope, const Plane& plane) {
  return clip(std::move(polytope), std::span(&plane, 1));
}

Polytope clip(Polytope polytope, std::span<const Plane> planes) {
  Clipper clipper(polytope);
  for (const Plane& plane : planes) {
    if (polytope.empty()) break;
    clipper.clip(plane);
  }
  return polytope;
}

Polytope transform(const glm::dmat4& to_from, const Polytope& polytope) {
  Polytope result = polytope;
  for (Polytope::Face& face : result.faces) {
    for (glm::dvec3& p : face.polygon) {
      const glm::dvec4 q = to_from * glm::dvec4(p, 1.0);
      p = glm::dvec3(q) / q.w;
    }
  }
  const glm::dvec3 inside = mean(result.points());
  for (Polytope::Face& face : result.faces) {
    // Newell's normal serves a planar polygon whatever its corners. A map that mirrors turns the winding.
    const glm::dvec3 center = mean(face.polygon);
    glm::dvec3 normal(0.0);
    for (size_t i = 0; i < face.polygon.size(); ++i)
      normal -= glm::cross(face.polygon[i] - center, face.polygon[(i + 1) % face.polygon.size()] - center);
    if (glm::dot(normal, inside - center) < 0) {
      normal = -normal;
      std::reverse(face.polygon.begin(), face.polygon.end());
    }
    const double length = glm::length(normal);
    if (length > 0) face.plane = {normal / length, -glm::dot(normal, center) / length};
  }
  return result;
}

std::vector<Plane> hull_planes(const Polytope& polytope, const glm::dvec4& point) {
  std::vector<Plane> planes;
  const std::vector<glm::dvec3> corners = polytope.points();
  const glm::dvec3 inside = mean(corners);
  const double epsilon = 1e-9 * polytope.bounds().diagonal();
  const auto holds_corners = [&](const Plane& plane) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const glm::dvec3& p) { return plane.distance(p) >= -epsilon; });
  };
  for (const Polytope::Face& face : polytope.faces) {
    const double height = glm::dot(face.plane.normal, glm::dvec3(point)) + face.plane.offset * point.w;
    if (height >= 0) {
      planes.push_back(face.plane);
      continue;
    }
    // The face is seen from the point, so it is inside the hull. Of the planes through the point and its edges those
    // that have the polytope on one side bound the hull.
    for (size_t i = 0; i < face.polygon.size(); ++i) {
      const glm::dvec3 &a = face.polygon[i], &b = face.polygon[(i + 1) % face.polygon.size()];
      const glm::dvec3 towards = glm::dvec3(point) - point.w * a;
      const glm::dvec3 normal = glm::cross(b - a, towards);
      const double length = glm::length(normal);
      if (!(length > 1e-9 * glm::length(b - a) * glm::length(towards))) continue;
      Plane plane{normal / length, -glm::dot(normal, a) / length};
      if (plane.distance(inside) < 0) plane = {-plane.normal, -plane.offset};
      if (holds_corners(plane)) planes.push_back(plane);
    }
  }
  return planes;
}

std::vector<Plane> frustum_planes(const glm::dmat4& clip_from_space) {
  // Gribb and Hartmann (2001): each inequality is linear in the point, its coefficients are sums of the matrix's rows.
  const glm::dmat4 rows = glm::transpose(clip_from_space);
  const std::array<glm::dvec4, 6> inequalities = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                                                  rows[3] - rows[1], rows[2],           rows[3] - rows[2]};
  double longest = 0.0;
  for (const glm::dvec4& p : inequalities) longest = std::max(longest, glm::length(glm::dvec3(p)));

  std::vector<Plane> planes;
  for (const glm::dvec4& p : inequalities) {
    const double length = glm::length(glm::dvec3(p));
    if (length > 1e-12 * longest) planes.push_back({glm::dvec3(p) / length, p.w / length});
  }
  return planes;
}

bool outside(const Box& box, std::span<const Plane> planes) {
  if (box.empty()) return true;
  for (const Plane& plane : planes) {
    // The corner furthest along the normal: if even that is outside, all are.
    const glm::dvec3 furthest(plane.normal.x > 0 ? box.max.x : box.min.x, plane.normal.y > 0 ? box.max.y : box.min.y,
                              plane.normal.z > 0 ? box.max.z : box.min.z);
    if (plane.distance(furthest) < 0) return true;
  }
  return false;
}

}  // namespace shadewright
