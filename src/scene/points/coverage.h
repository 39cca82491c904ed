// How far each piece of a surface is from the samples placed so far, and which is the nearest: a sample at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/points/pieces.h"
#include "shadewright/scene/points.h"

namespace shadewright::points {

class Coverage {
 public:
  /// `surface` stays alive as long as this. Until the first sample everything is infinitely far.
  explicit Coverage(const Pieces& surface);

  /// The next sample, numbered from 0. `bound`: no piece is farther than this from the samples before it (as `Farthest`
  /// or PointSampling::radii told).
  void insert(const SurfaceSample& sample, float bound);

  struct Farthest {
    uint32_t piece = 0;
    float bound = 0;     ///< no point of the surface is farther than this from its sample
    bool again = false;  ///< a sample lies at the piece's centre already
  };
  /// The piece with the point that is farthest from all samples; there must be one sample.
  Farthest farthest();

  /// The nearest sample of each piece.
  std::vector<uint32_t> owners() const;

 private:
  struct Entry {
    glm::vec3 center, normal;
    float reach, distance;
    uint32_t owner, piece;

    float bound() const { return distance + reach; }
  };
  struct Candidate {
    float bound;
    uint32_t piece, entry;

    bool operator<(const Candidate& other) const {  // the farthest, then the first piece, comes to the top
      return bound != other.bound ? bound < other.bound : piece > other.piece;
    }
  };

  void sort_into_cells(float size);
  void collect_candidates();
  uint64_t cell_of(const glm::vec3& p) const;

  std::vector<Entry> entries_;   ///< by cell
  std::vector<uint64_t> cells_;  ///< of each entry, ascending
  std::vector<Candidate> heap_;  ///< lazily kept: a candidate's bound may have shrunk since
  float least_candidate_ = 0;    ///< pieces nearer than this are not in the heap
  float cell_size_ = 0;          ///< 0 = all in one
  glm::vec3 corner_{0.0f};
  glm::uvec3 size_{1};  ///< cells along each axis
  uint32_t count_ = 0;
};

}  // namespace shadewright::points
