#include "tile.h"

#include <algorithm>
#include <cmath>

namespace shadewright::voxel {

namespace {

/// The interval of texels of a row that lie inside of an edge, stepped from row to row without a division (exact).
/// With x = x0 + 256 i, edge(i) = e0 - 256 dy i >= least bounds i by floor((e0 - least) / (256 |dy|)).
class EdgeRows {
 public:
  EdgeRows(const EdgeFunction& edge, int64_t px, int64_t py) : dy_(edge.dy) {
    const int64_t value = edge.at(px, py) - edge.least;
    if (dy_ == 0) {
      quotient_ = value;
      step_ = kSubVoxels * edge.dx;
      return;
    }
    divisor_ = kSubVoxels * std::abs(dy_);
    divide(value, quotient_, rest_);
    divide(kSubVoxels * edge.dx, step_, step_rest_);
  }

  void narrow(int32_t& low, int32_t& high) const {
    if (dy_ == 0) {
      if (quotient_ < 0) high = -1;
    } else if (dy_ > 0) {
      high = int32_t(std::min<int64_t>(high, std::max<int64_t>(quotient_, -1)));
    } else {
      low = int32_t(std::max<int64_t>(low, std::min<int64_t>(-quotient_, kTileStride)));
    }
  }

  void next() {
    quotient_ += step_;
    rest_ += step_rest_;
    if (rest_ >= divisor_ && dy_ != 0) rest_ -= divisor_, ++quotient_;
  }

 private:
  void divide(int64_t value, int64_t& quotient, int64_t& rest) const {
    quotient = value / divisor_;
    rest = value % divisor_;
    if (rest < 0) rest += divisor_, --quotient;
  }

  int64_t dy_, quotient_ = 0, rest_ = 0, step_ = 0, step_rest_ = 0, divisor_ = 1;
};

/// floor(plane) is `exact_height` wherever the distance to the next integer exceeds `error`. Operations round by at
/// most 2^-53 relative each; the bound below counts them generously.
HeightPlane height_plane(const QuadTriangle& triangle, int32_t x, int32_t y, uint32_t side) {
  const glm::dvec3 a(triangle.triangle.corners[0]);
  const glm::dvec2 slope = triangle.slope;
  const double px = double(texel_center(x)) - a.x, py = double(texel_center(y)) - a.y,
               reach = double(side) * kSubVoxels;
  HeightPlane plane;
  plane.base = (a.z + slope.x * px + slope.y * py) / kSubVoxels + 0.5;
  plane.x = slope.x;  // per texel: 256 sub-voxels along x, 256 sub-voxels a voxel in z
  plane.y = slope.y;
  const double size =
      std::abs(a.z) + std::abs(slope.x) * (std::abs(px) + reach) + std::abs(slope.y) * (std::abs(py) + reach);
  plane.error = size / kSubVoxels * 0x1p-48 + 0x1p-40;
  return plane;
}

}  // namespace

/// Which texels of the widened tile the triangle covers; false if none.
bool TileRasterizer::find_rows(const QuadTriangle& triangle, int32_t x, int32_t y) {
  const SnappedTriangle& t = triangle.triangle;
  const int64_t side = this->side(), px = texel_center(x), py = texel_center(y), last = (side - 1) * kSubVoxels;
  // Rows and columns whose centres lie in the triangle's box.
  const int64_t first = std::max<int64_t>(0, (triangle.low.y - py + kSubVoxels - 1) >> 8);
  const int64_t end = std::min(side, ((triangle.high.y - py) >> 8) + 1);
  const int64_t left_most = std::max<int64_t>(0, (triangle.low.x - px + kSubVoxels - 1) >> 8);
  const int64_t right_most = std::min(side - 1, (triangle.high.x - px) >> 8);
  if (first >= end || left_most > right_most) return false;
  first_row_ = uint32_t(first), end_row_ = uint32_t(end);
  std::array<EdgeRows, 3> steps{EdgeRows({}, 0, 0), EdgeRows({}, 0, 0), EdgeRows({}, 0, 0)};
  size_t edges = 0;
  for (int e = 0; e < 3; ++e) {
    const EdgeFunction edge = edge_function(t, e);
    const int64_t corner = edge.at(px, py), along_x = -edge.dy * last, along_y = edge.dx * last;
    if (corner + std::max<int64_t>(along_x, 0) + std::max<int64_t>(along_y, 0) < edge.least) return false;
    if (corner + std::min<int64_t>(along_x, 0) + std::min<int64_t>(along_y, 0) >= edge.least) continue;
    steps[edges++] = EdgeRows(edge, px, py + first * kSubVoxels);
  }
  uint64_t any = 0;
  for (uint32_t j = first_row_; j < end_row_; ++j) {
    int32_t left = int32_t(left_most), right = int32_t(right_most);
    for (size_t e = 0; e < edges; ++e) {
      steps[e].narrow(left, right);
      steps[e].next();
    }
    rows_[j] = left > right ? 0 : (~uint64_t(0) >> (63 - right)) & (~uint64_t(0) << left);
    any |= rows_[j];
  }
  return any != 0;
}

TileRasterizer::Layer& TileRasterizer::layer_for(Crossing crossing) {
  for (size_t l = 0; l < used_layers_; ++l) {
    Layer& layer = layers_[l];
    if (layer.crossing != crossing) continue;
    uint64_t overlap = 0;
    for (uint32_t j = first_row_; j < end_row_; ++j) overlap |= layer.rows[j] & rows_[j];
    if (overlap == 0) return layer;
  }
  if (used_layers_ == layers_.size()) layers_.emplace_back();
  Layer& layer = layers_[used_layers_++];
  layer.crossing = crossing;
  layer.rows.fill(0);
  std::fill_n(layer.heights.begin(), side() * kTileStride, kNoHit);
  return layer;
}

void TileRasterizer::draw(const QuadTriangle& triangle, int32_t x, int32_t y, Layer& layer) {
  TileRows uncertain;
  const HeightPlane plane = height_plane(triangle, x, y, side());
  if (plane.error < 0.25)
    fill_heights(plane, rows_, first_row_, end_row_, layer.heights.data(), uncertain);
  else
    uncertain = rows_;
  for (uint32_t j = first_row_; j < end_row_; ++j) {
    layer.rows[j] |= rows_[j];
    for (uint64_t bits = uncertain[j]; bits != 0; bits &= bits - 1) {
      const int i = std::countr_zero(bits);
      layer.heights[j * kTileStride + uint32_t(i)] =
          int32_t(exact_height(triangle.triangle, texel_center(x + i), texel_center(y + int64_t(j))));
    }
  }
}

bool TileRasterizer::all_covered() const {
  const uint64_t full = (uint64_t(1) << side()) - 1;
  for (uint32_t j = 0; j < side(); ++j) {
    uint64_t row = 0;
    for (size_t l = 0; l < used_layers_; ++l) row |= layers_[l].rows[j];
    if (row != full) return false;
  }
  return true;
}

void TileRasterizer::rasterize(std::span<const QuadTriangle* const> triangles, std::span<const int32_t> lows,
                               std::span<const int32_t> highs, int32_t x, int32_t y, TileRanges& ranges) {
  const int32_t left = x - int32_t(rules_.reach), top = y - int32_t(rules_.reach);
  order_.clear();
  for (uint32_t t = 0; t < triangles.size(); ++t) order_.emplace_back(lows[t], t);
  std::sort(order_.begin(), order_.end());
  used_layers_ = 0;
  int32_t drawn_to = INT32_MIN, rest_from = kNoHit;
  for (const auto& [low, t] : order_) {
    if (low > drawn_to && drawn_to != INT32_MIN && all_covered()) {
      rest_from = low;
      break;
    }
    drawn_to = std::max(drawn_to, highs[t]);
    if (find_rows(*triangles[t], left, top)) draw(*triangles[t], left, top, layer_for(triangles[t]->triangle.crossing));
  }
  views_.clear();
  for (size_t l = 0; l < used_layers_; ++l) views_.push_back({layers_[l].heights.data(), int32_t(layers_[l].crossing)});
  const RangeRows rows{first_.data(), limit_.data(), next_.data(), next_limit_.data()};
  resolve_layers(views_, side(), rules_.static_receivers, rest_from, rows);
  std::copy_n(limit_.begin(), side() * kTileStride, guard_.begin());
  if (rules_.reach > 0) {
    window_minimum(guard_.data(), side(), rules_.reach);
    raise_pinned(rows, rules_.reach, rules_.margin, guard_.data());
  }
  for (uint32_t j = 0; j < kTileSide; ++j) {
    const int32_t* first = &first_[(j + rules_.reach) * kTileStride + rules_.reach];
    const int32_t* limit = &guard_[j * kTileStride];
    for (uint32_t i = 0; i < kTileSide; ++i) {
      const int32_t from = std::clamp(first[i], 0, rules_.depth);
      ranges.first[j * kTileSide + i] = from;
      ranges.limit[j * kTileSide + i] =
          std::clamp(limit[i] == kNoHit ? kNoHit : limit[i] - rules_.margin, from, rules_.depth);
    }
  }
}

}  // namespace shadewright::voxel
