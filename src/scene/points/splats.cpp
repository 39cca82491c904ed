// From samples to polygons: each splat stands for the pieces of surface nearest to its sample.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/conditioning.h"
#include "scene/points/coverage.h"
#include "scene/points/pieces.h"
#include "shadewright/geometry/projection.h"
#include "shadewright/scene/points.h"

namespace shadewright {
namespace {

using points::Component, points::Coverage, points::Piece, points::Pieces;

/// What a splat must show, gathered piece by piece, in the tangent plane of its sample.
class Cell {
 public:
  explicit Cell(const SurfaceSample& sample) : origin_(sample.position) {
    perpendicular_axes(glm::dvec3(sample.normal), u_, v_);
  }

  void add(const Piece& piece, const Component& component, bool is_grain) {
    const double area = double{piece.area};
    const glm::dvec2 a = flat(piece.corners[0]), b = flat(piece.corners[1]), c = flat(piece.corners[2]),
                     m = (a + b + c) / 3.0;
    // Second moments of a triangle: area / 12 times its corners' and 9 times its centroid's squares.
    const auto moment = [&](int i, int j) {
      return area / 12.0 * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + 9.0 * m[i] * m[j]);
    };
    area_ += area;
    first_ += area * m;
    uu_ += moment(0, 0);
    uv_ += moment(0, 1);
    vv_ += moment(1, 1);
    centroid_ += area * (glm::dvec3(piece.center) - origin_);
    if (is_grain)
      grain_area_ += component.closed ? 0.5 * area : area;
    else
      is_covering_ = true;
  }

  /// Lays the splat's axes along the cell's longer and shorter extent; `extend` follows with every piece.
  void choose_axes() {
    if (!(area_ > 0)) return;
    const glm::dvec2 mean = first_ / area_;
    const double uu = uu_ / area_ - mean.x * mean.x, uv = uv_ / area_ - mean.x * mean.y,
                 vv = vv_ / area_ - mean.y * mean.y;
    const double angle = 0.5 * std::atan2(2.0 * uv, uu - vv), c = std::cos(angle), s = std::sin(angle);
    deviation_ = {std::sqrt(std::max(0.0, c * c * uu + 2.0 * c * s * uv + s * s * vv)),
                  std::sqrt(std::max(0.0, s * s * uu - 2.0 * c * s * uv + c * c * vv))};
    const glm::dvec3 u = c * u_ + s * v_, v = -s * u_ + c * v_;
    u_ = u;
    v_ = v;
  }

  void extend(const Piece& piece, bool is_grain) {
    for (const glm::vec3& corner : piece.corners) {
      const glm::dvec2 p = flat(corner);
      low_ = glm::min(low_, p);
      high_ = glm::max(high_, p);
      if (is_grain) continue;
      cover_low_ = glm::min(cover_low_, p);
      cover_high_ = glm::max(cover_high_, p);
    }
  }

  void append_to(Mesh& mesh) const {
    if (!(area_ > 0)) return;
    if (is_covering_)
      append_rectangle(mesh);
    else
      append_grain(mesh);
  }

 private:
  glm::dvec2 flat(const glm::vec3& p) const {
    const glm::dvec3 from = glm::dvec3(p) - origin_;
    return {glm::dot(from, u_), glm::dot(from, v_)};
  }

  /// Covers the wide surfaces' part, and adds the grains' area.
  void append_rectangle(Mesh& mesh) const {
    const glm::dvec2 center = 0.5 * (cover_low_ + cover_high_);
    glm::dvec2 half = 0.5 * (cover_high_ - cover_low_);
    const double covered = 4.0 * half.x * half.y, wanted = std::min(covered + grain_area_, bounding_area());
    // Rounding to float must not open a hair of a gap.
    half *= (1.0 + 1e-6) * std::sqrt(std::max(1.0, wanted / covered));
    const glm::dvec3 middle = origin_ + center.x * u_ + center.y * v_, du = half.x * u_, dv = half.y * v_;
    append_polygon(mesh, std::array{middle - du - dv, middle + du - dv, middle + du + dv, middle - du + dv});
  }

  /// A triangle with the spread of all leaves here and their area, but no larger than the rectangle about them: where
  /// they hide each other, that is all there is to see.
  void append_grain(Mesh& mesh) const {
    const double wanted = std::min(grain_area_, bounding_area());
    // An equilateral triangle of circumradius 1 has area 3 sqrt(3) / 4 and variance 1/8 along every axis.
    glm::dvec2 radii = std::sqrt(8.0) * deviation_;
    radii *= std::sqrt(wanted / (0.75 * std::sqrt(3.0) * radii.x * radii.y));
    const glm::dvec3 middle = origin_ + centroid_ / area_;
    append_polygon(mesh, std::array{middle + radii.x * u_, middle - 0.5 * radii.x * u_ + radii.y * half_root_3 * v_,
                                    middle - 0.5 * radii.x * u_ - radii.y * half_root_3 * v_});
  }

  double bounding_area() const { return (high_.x - low_.x) * (high_.y - low_.y); }

  template <size_t N>
  static void append_polygon(Mesh& mesh, const std::array<glm::dvec3, N>& corners) {
    if (!has_area(glm::vec3(corners[0]), glm::vec3(corners[1]), glm::vec3(corners[2]))) return;
    const auto base = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::dvec3& corner : corners) mesh.positions.emplace_back(corner);
    for (uint32_t k = 2; k < N; ++k) mesh.triangles.emplace_back(base, base + k - 1, base + k);
  }

  static constexpr double infinite = std::numeric_limits<double>::infinity();
  static constexpr double half_root_3 = 0.86602540378443865;

  glm::dvec3 origin_, u_{0.0}, v_{0.0};
  double area_ = 0, grain_area_ = 0, uu_ = 0, uv_ = 0, vv_ = 0;
  glm::dvec2 first_{0.0}, deviation_{0.0};
  glm::dvec3 centroid_{0.0};
  bool is_covering_ = false;
  glm::dvec2 low_{infinite}, high_{-infinite}, cover_low_{infinite}, cover_high_{-infinite};
};

Mesh make_splats(const Mesh& mesh, const Pieces& surface, std::span<const SurfaceSample> samples, float radius,
                 std::span<const uint32_t> owners) {
  std::vector<Cell> cells(samples.begin(), samples.end());
  std::vector<uint8_t> is_grain;
  for (const Component& component : surface.components) is_grain.push_back(component.width() < double{radius});
  for (size_t i = 0; i < owners.size(); ++i) {
    const uint32_t component = surface.pieces[i].component;
    cells[owners[i]].add(surface.pieces[i], surface.components[component], is_grain[component]);
  }
  for (Cell& cell : cells) cell.choose_axes();
  for (size_t i = 0; i < owners.size(); ++i)
    cells[owners[i]].extend(surface.pieces[i], is_grain[surface.pieces[i].component]);
  Mesh splats;
  splats.name = mesh.name + " in " + std::to_string(samples.size()) + " points";
  for (const Cell& cell : cells) cell.append_to(splats);
  return splats;
}

}  // namespace

std::vector<Mesh> splat_meshes(const Mesh& mesh, const PointSampling& sampling, std::span<const size_t> counts) {
  // The same pieces, and the same samples in the same order, as sampling had them.
  const Pieces surface = points::cut(mesh, sampling.piece_size);
  Coverage coverage(surface);
  std::vector<Mesh> result;
  size_t inserted = 0;
  for (const size_t count : counts) {
    for (; inserted < std::min(count, sampling.samples.size()); ++inserted)
      coverage.insert(sampling.samples[inserted],
                      inserted == 0 ? std::numeric_limits<float>::infinity() : sampling.radii[inserted - 1]);
    if (inserted == 0) {
      result.emplace_back().name = mesh.name;
      continue;
    }
    result.push_back(make_splats(mesh, surface, std::span(sampling.samples).first(inserted),
                                 sampling.radii[inserted - 1], coverage.owners()));
  }
  return result;
}

Mesh splat_mesh(const Mesh& mesh, const PointSampling& sampling, size_t count) {
  return std::move(splat_meshes(mesh, sampling, std::span(&count, 1)).front());
}

}  // namespace shadewright
