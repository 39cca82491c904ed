#include "scene/points/coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shadewright::points {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// At least the Euclidean distance; up to twice that between surfaces that stand upright on each other.
float distance(const glm::vec3& p, const glm::vec3& normal, const SurfaceSample& sample) {
  return glm::distance(p, sample.position) * (2.0f - std::min(1.0f, std::abs(glm::dot(normal, sample.normal))));
}

}  // namespace

Coverage::Coverage(const Pieces& surface) {
  entries_.reserve(surface.pieces.size());
  for (const Piece& piece : surface.pieces)
    entries_.push_back({piece.center, piece.normal, piece.reach, infinite, 0, static_cast<uint32_t>(entries_.size())});
  cells_.assign(entries_.size(), 0);
}

uint64_t Coverage::cell_of(const glm::vec3& p) const {
  if (cell_size_ == 0) return 0;
  const glm::uvec3 cell = glm::min(glm::uvec3((p - corner_) / cell_size_), size_ - 1u);
  return (uint64_t{cell.z} * size_.y + cell.y) * size_.x + cell.x;
}

void Coverage::sort_into_cells(float size) {
  glm::vec3 low(infinite), high(-infinite);
  for (const Entry& entry : entries_) {
    low = glm::min(low, entry.center);
    high = glm::max(high, entry.center);
  }
  corner_ = low;
  cell_size_ = size;
  size_ = glm::uvec3((high - low) / size) + 1u;
  std::vector<std::pair<uint64_t, uint32_t>> order(entries_.size());
  for (uint32_t i = 0; i < entries_.size(); ++i) order[i] = {cell_of(entries_[i].center), i};
  std::sort(order.begin(), order.end());
  std::vector<Entry> sorted;
  sorted.reserve(entries_.size());
  for (size_t i = 0; i < order.size(); ++i) {
    sorted.push_back(entries_[order[i].second]);
    cells_[i] = order[i].first;
  }
  entries_ = std::move(sorted);
  heap_.clear();
  least_candidate_ = 0;
}

void Coverage::insert(const SurfaceSample& sample, float bound) {
  const uint32_t index = count_++;
  // Cells as large as the bound: what the sample can come nearer to lies in its own and the adjacent ones.
  if (bound < infinite && bound > 0 && (cell_size_ == 0 || bound < 0.5f * cell_size_)) sort_into_cells(bound);
  const auto update = [&](Entry& entry) {
    const float d = distance(entry.center, entry.normal, sample);
    if (d >= entry.distance) return;
    entry.distance = d;
    entry.owner = index;
  };
  if (cell_size_ == 0) {
    std::for_each(entries_.begin(), entries_.end(), update);
    return;
  }
  const glm::ivec3 at((sample.position - corner_) / cell_size_), last = glm::ivec3(size_) - 1;
  const glm::ivec3 from = glm::clamp(at - 1, glm::ivec3(0), last), to = glm::clamp(at + 1, glm::ivec3(0), last);
  for (int z = from.z; z <= to.z; ++z)
    for (int y = from.y; y <= to.y; ++y) {
      const uint64_t row = (static_cast<uint64_t>(z) * size_.y + static_cast<uint64_t>(y)) * size_.x;
      const auto first =
          std::lower_bound(cells_.begin(), cells_.end(), row + static_cast<uint64_t>(from.x)) - cells_.begin();
      for (auto i = static_cast<size_t>(first); i < entries_.size() && cells_[i] <= row + static_cast<uint64_t>(to.x);
           ++i)
        update(entries_[i]);
    }
}

void Coverage::collect_candidates() {
  float farthest = 0;
  for (const Entry& entry : entries_) farthest = std::max(farthest, entry.bound());
  least_candidate_ = 0.5f * farthest;
  heap_.clear();
  for (uint32_t i = 0; i < entries_.size(); ++i)
    if (entries_[i].bound() >= least_candidate_) heap_.push_back({entries_[i].bound(), entries_[i].piece, i});
  std::make_heap(heap_.begin(), heap_.end());
}

Coverage::Farthest Coverage::farthest() {
  for (;;) {
    if (heap_.empty()) collect_candidates();
    const Candidate top = heap_.front();
    const Entry& entry = entries_[top.entry];
    if (entry.bound() == top.bound) return {top.piece, top.bound, entry.distance == 0};
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
    if (entry.bound() < least_candidate_) continue;
    heap_.push_back({entry.bound(), top.piece, top.entry});
    std::push_heap(heap_.begin(), heap_.end());
  }
}

std::vector<uint32_t> Coverage::owners() const {
  std::vector<uint32_t> result(entries_.size());
  for (const Entry& entry : entries_) result[entry.piece] = entry.owner;
  return result;
}

}  // namespace shadewright::points
