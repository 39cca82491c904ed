#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/points/coverage.h"
#include "scene/points/pieces.h"
#include "shadewright/scene/points.h"

namespace shadewright {
namespace {

using points::Coverage, points::Piece, points::Pieces;

/// The piece nearest to the surface's centroid: where one point alone stands for it best.
uint32_t central_piece(const Pieces& surface) {
  glm::dvec3 sum(0.0);
  double area = 0;
  for (const Piece& piece : surface.pieces) {
    sum += double{piece.area} * glm::dvec3(piece.center);
    area += double{piece.area};
  }
  const glm::vec3 centroid(sum / area);
  const auto nearest =
      std::min_element(surface.pieces.begin(), surface.pieces.end(), [&](const Piece& a, const Piece& b) {
        return glm::distance(a.center, centroid) < glm::distance(b.center, centroid);
      });
  return static_cast<uint32_t>(nearest - surface.pieces.begin());
}

}  // namespace

PointSampling sample_points(const Mesh& mesh, size_t most_samples) {
  PointSampling sampling;
  // Pieces about as large as a sample's share of the surface.
  sampling.piece_size = std::sqrt(points::surface_area(mesh) / static_cast<double>(std::max<size_t>(1, most_samples)));
  const Pieces surface = points::cut(mesh, sampling.piece_size);
  if (surface.pieces.empty()) return sampling;
  Coverage coverage(surface);
  uint32_t piece = central_piece(surface);
  float bound = std::numeric_limits<float>::infinity();
  while (sampling.samples.size() < most_samples) {
    sampling.samples.push_back({surface.pieces[piece].center, surface.pieces[piece].normal});
    coverage.insert(sampling.samples.back(), bound);
    const Coverage::Farthest farthest = coverage.farthest();
    piece = farthest.piece;
    bound = farthest.bound;
    sampling.radii.push_back(bound);
    if (farthest.again) break;
  }
  return sampling;
}

}  // namespace shadewright
